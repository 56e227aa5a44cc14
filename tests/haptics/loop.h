// Fixture: a simulated hand in the loop of the servo, on a virtual clock; each test supplies the
// tissue.
#pragma once

#include <string>

#include "haptics/device.h"

namespace mvs::core {

class ServoLoop {
 public:
  explicit ServoLoop(const std::string &options)
      : options_(options), device_(description(options_), {}) {
    device_.start();
  }

  Device &device() { return device_; }
  ServoStatus run(double seconds) {
    device_.advance(seconds);
    return device_.status();
  }
  ServoStatus run_stopped() { return device_.status(); }
  void post(const TissueModel &tissue) { device_.links().tissue.post(tissue); }
  // Enables forces: passes the force gate and the ramp.
  void arm() {
    device_.advance(5e-3);
    device_.arm();
    post({});
    mvs_device_limits limits = {};
    limits.ramp_s = 0.01;
    limits.stale_s = 10;
    device_.set_limits(limits);
    device_.advance(0.03);
  }
  double period() const { return 1 / device_.info().rate; }

 private:
  static mvs_device_desc description(const std::string &options) {
    mvs_device_desc desc = {};
    desc.struct_size = sizeof desc;
    desc.clock = MVS_CLOCK_VIRTUAL;
    desc.driver = MVS_DRIVERS_DIR "/hand.so";
    desc.options = options.c_str();
    return desc;
  }

  std::string options_;
  Device device_;
};

// A spring to a fixed place, as when grasping an immobile object.
inline TissueModel spring(double stiffness, const Vec3 &to = Vec3::Zero()) {
  TissueModel tissue;
  tissue.kind = TissueModel::held;
  tissue.contact = 1;
  tissue.origin = to;
  tissue.stiffness = stiffness * Mat3::Identity();
  tissue.most = 1000;
  return tissue;
}

}  // namespace mvs::core
