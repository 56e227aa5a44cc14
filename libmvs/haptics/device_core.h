// The state that an open device shares with the thread of its servo.
#pragma once

#include <atomic>
#include <condition_variable>

#include "haptics/device.h"

namespace mvs::core {

struct Device::Core : std::enable_shared_from_this<Device::Core> {
  // Runs the servo until `stopping`, on the driver's own clock or by polling; body of the thread.
  void serve();
  // Exchanges one sample and its force, on a virtual clock.
  void poll(uint64_t now_ns);
  // Returns whether the servo thread exists; true also while it hangs.
  bool is_running();
  bool is_lost() const { return *lost; }
  // Writes zero force to a polled device, on the thread that uses it.
  int32_t write_zero();
  void prepare_close();
  void close() noexcept;

  std::shared_ptr<DriverPlugin> plugin;
  mvs_driver_device *handle = nullptr;
  DeviceTraits traits;
  DeviceClock clock = DeviceClock::real;
  std::unique_ptr<ServoLinks> links;
  std::unique_ptr<Servo> servo;
  uint64_t now_ns = 0;  // virtual clock, which goes on after a stop
  double due = 0;       // s of virtual time less than a tick, carried over

  std::atomic<bool> stopping{false}, panicked{false};
  std::atomic<uint32_t> realtime{0};
  std::atomic<int64_t> last_tick_ns{0};  // of the servo thread, monotonic clock
  std::mutex mutex;                      // protects `running` and `lost`
  std::condition_variable ended;
  bool running = false;
  char lost[200] = "";  // the driver's error message if its loop ended unasked
  // Calls of the driver that are made ready before they are needed, so that a device can be stopped
  // and closed without memory. They share this core, until they are made or dropped.
  DriverPlugin::Prepared stop_call, close_call;

 private:
  static int32_t serve_sample(void *core, const mvs_driver_state *state, mvs_driver_force *force);
  bool is_polled() const;
  int32_t poll_until_stopped();
  void tick(const mvs_driver_state &state, mvs_driver_force &force);
  int32_t exchange(uint64_t now_ns);
  void lose(int32_t code, const char *otherwise);
};

// The monotonic clock, ns.
uint64_t clock_ns();

}  // namespace mvs::core
