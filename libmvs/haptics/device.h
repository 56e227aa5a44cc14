// An open haptic device: its driver plugin, its servo, and the thread or virtual clock that runs
// the servo.
#pragma once

#include <atomic>
#include <mutex>
#include <string>
#include <thread>

#include "haptics/driver_plugin.h"
#include "haptics/servo.h"

namespace mvs::core {

class Device {
 public:
  Device(const mvs_device_desc &desc, DriverPlugin::Log log);
  ~Device();
  Device(const Device &) = delete;
  Device &operator=(const Device &) = delete;

  mvs_device_info info() const;
  const mvs_device_limits &limits() const { return limits_; }
  void set_limits(const mvs_device_limits &given);

  void start();
  void stop();
  void arm();
  void cut();
  void advance(double seconds);

  // Returns the newest status of the servo; callable from any thread.
  ServoStatus status();
  // For use by one thread.
  ServoLinks &links();

 private:
  struct Core;
  void start_thread();
  bool end_servo() noexcept;
  void must_be_started(const char *call) const;

  std::shared_ptr<Core> core_;  // shared with the servo thread, which may hang in the driver
  mvs_device_limits limits_ = {};
  std::mutex reading_;  // protects the reader side of the status mailbox
  std::atomic<bool> started_{false};
  std::thread servo_thread_;
};

}  // namespace mvs::core
