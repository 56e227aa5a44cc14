// Fixture: a servo without a driver or a thread; each test supplies the samples.
#pragma once

#include <algorithm>
#include <memory>

#include "haptics/servo.h"

namespace mvs::core {

// A servo without a driver, which returns the output for a sample.
class BareServo {
 public:
  BareServo(uint32_t freedoms_in, uint32_t freedoms_out) {
    mvs_driver_info info = {};
    info.struct_size = sizeof info;
    info.freedoms_in = freedoms_in;
    info.freedoms_out = freedoms_out;
    info.peak_torque = 0.2;
    traits_ = read_traits(info, "bare");
    mvs_device_limits limits = {};
    limits.ramp_s = 0.01;
    limits.stale_s = 10;
    servo_ = std::make_unique<Servo>(traits_, resolve_limits(limits, traits_.info), links_);
    servo_->start();
  }
  mvs_driver_force tick(const Eigen::Quaterniond &turn = Eigen::Quaterniond::Identity(),
                        const Vec3 &position = Vec3(1e-3, 0, 0), uint64_t ns = 1000000) {
    mvs_driver_state sample = {};
    sample.struct_size = sizeof sample;
    sample.flags = MVS_DRIVER_FLAG_CALIBRATED;
    sample.time_ns = now_ += ns;
    sample.sequence = now_;
    std::copy_n(position.data(), 3, sample.position);
    sample.orientation[0] = turn.w();
    for (int k = 0; k < 3; ++k) sample.orientation[1 + k] = turn.vec()[k];
    mvs_driver_force force = {};
    force.torque[0] = 1;  // has to be overwritten
    servo_->tick(sample, force);
    return force;
  }
  // Passes the force gate and the ramp.
  void arm() {
    tick();
    links_.requests.arm();
    links_.tissue.post({});
    for (int k = 0; k < 30; ++k) tick();
  }
  void set_limits(const mvs_device_limits &given) {
    links_.limits.post(resolve_limits(given, traits_.info));
  }
  ServoLinks &links() { return links_; }
  ServoStatus status() {
    links_.status.refresh();
    return links_.status.get();
  }

 private:
  DeviceTraits traits_;
  ServoLinks links_;
  std::unique_ptr<Servo> servo_;
  uint64_t now_ = 0;
};

}  // namespace mvs::core
