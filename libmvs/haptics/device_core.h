// What an open device and the thread of its servo share.
#pragma once

#include <atomic>
#include <condition_variable>

#include "haptics/device.h"

namespace mvs::core {

struct Device::Core : std::enable_shared_from_this<Device::Core> {
  // Runs the servo on the device's clock, or polls it, until `stopping`; on a thread of its own.
  void serve();
  // One sample and its force, on a virtual clock.
  void poll(uint64_t now_ns);
  // Whether the thread is, also one that hangs.
  bool is_running();
  void close();

  std::shared_ptr<DriverPlugin> plug;
  mvs_driver_device *handle = nullptr;
  DeviceTraits traits;
  uint32_t clock = MVS_CLOCK_REAL;
  std::unique_ptr<ServoLinks> links;
  std::unique_ptr<Servo> servo;
  uint64_t now_ns = 0;  // of a virtual clock
  double due = 0;       // s of a virtual clock that are no whole tick yet

  std::atomic<bool> stopping{false};
  std::atomic<uint32_t> realtime{0};
  std::atomic<int64_t> last_tick_ns{0};  // of the thread, on the monotonic clock
  std::mutex mutex;                      // of the next two
  std::condition_variable ended;
  bool running = false;
  std::string lost;  // the driver's sentence when the thread ended by itself

 private:
  static int32_t serve_sample(void *core, const mvs_driver_state *state, mvs_driver_force *force);
  int32_t poll_until_stopped();
  void tick(const mvs_driver_state &state, mvs_driver_force &force);
  int32_t exchange(uint64_t now_ns);
  void lose(int32_t code, const char *otherwise);
};

// Monotonic, ns.
uint64_t clock_ns();

}  // namespace mvs::core
