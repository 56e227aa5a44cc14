// An open device: its driver, its servo, and the thread or clock that turns it.
#pragma once

#include <atomic>
#include <mutex>
#include <string>

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

  // The servo as it is now, from any thread.
  ServoStatus status();
  // By one thread.
  ServoLinks &links();
  bool is_started() const { return started_; }

 private:
  struct Core;
  void start_thread();
  void must_be_started(const char *call) const;

  std::shared_ptr<Core> core_;  // shared with a thread that may hang
  mvs_device_limits limits_ = {};
  std::mutex reading_;  // of the status
  std::atomic<bool> started_{false};
};

}  // namespace mvs::core
