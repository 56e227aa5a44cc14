// What is wrong with a sample: lost, silent, no number, a jump, too fast, not calibrated, not held.
#pragma once

#include "haptics/servo_types.h"

namespace mvs::core {

class SampleValidator {
 public:
  explicit SampleValidator(const DeviceTraits &traits) : traits_(&traits) {}

  // Takes in a sample; the pose is in the frame of the device, dt since the last new sample.
  void take(const mvs_driver_state &sample, const mvs_device_limits &limits);
  void start();

  // The pose of the last sample that made sense.
  const HandPose &pose() const { return pose_; }
  // Since the last sample that was new; 0 for one that was not.
  double dt() const { return dt_; }
  // Since the last sample, new or not.
  double passed() const { return passed_; }
  uint32_t cause() const { return cause_; }
  bool is_parked() const { return (flags_ & MVS_DRIVER_FLAG_PARKED) != 0; }
  uint32_t flags() const { return flags_; }

 private:
  bool is_finite(const mvs_driver_state &sample) const;
  void take_time(const mvs_driver_state &sample);
  void take_pose(const mvs_driver_state &sample, const mvs_device_limits &limits);
  void take_velocity(const mvs_driver_state &sample, const Vec3 &step);
  void latch_cause(uint32_t cause) {
    if (cause_ == MVS_CAUSE_NONE) cause_ = cause;
  }

  const DeviceTraits *traits_;
  HandPose pose_;
  bool has_pose_ = false;
  uint64_t time_ns_ = 0, sequence_ = 0;
  double dt_ = 0, passed_ = 0, silent_ = 0;  // s
  uint32_t fast_ = 0;                        // samples above the speed limit
  uint32_t cause_ = MVS_CAUSE_NONE, flags_ = 0;
};

// Buttons that have stayed for a while; one that was down from the start counts from when it was
// up.
class Buttons {
 public:
  // True if a button has changed.
  bool take(uint32_t raw, double dt);
  void start() { *this = Buttons(); }
  uint32_t down() const { return steady_ & ~stuck_; }

 private:
  bool first_ = true;
  uint32_t steady_ = 0, stuck_ = 0;
  std::array<double, 32> since_ = {};  // s that each button has differed from what it is held to be
};

}  // namespace mvs::core
