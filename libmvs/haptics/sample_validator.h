// Validation of device samples: returns a cause to latch for a lost or silent device, a value that
// is not finite, a place out of reach, a clock that stands still, a jump, excessive speed, missing
// calibration, or a released dead-man's switch.
#pragma once

#include "haptics/servo_types.h"

namespace mvs::core {

class SampleValidator {
 public:
  explicit SampleValidator(const DeviceTraits &traits) : traits_(&traits) {}

  // Validates a sample and updates the pose, which is in the frame of the device.
  void take(const mvs_driver_state &sample, const mvs_device_limits &limits);
  void start();

  // The pose of the last valid sample.
  const HandPose &pose() const { return pose_; }
  bool has_pose() const { return has_pose_; }
  // Time since the last new sample, s; 0 if this sample is not new.
  double dt() const { return dt_; }
  // Time since the last sample, new or not, s.
  double passed() const { return passed_; }
  Cause cause() const { return cause_; }
  bool is_parked() const { return (flags_ & MVS_DRIVER_FLAG_PARKED) != 0; }
  uint32_t flags() const { return flags_; }
  // MVS_SAMPLE_FAULT_* of the last sample.
  uint32_t faults() const { return faults_; }

 private:
  void find_faults(const mvs_driver_state &sample);
  bool is_usable(const mvs_driver_state &sample) const;
  void take_time(const mvs_driver_state &sample);
  void take_pose(const mvs_driver_state &sample, const mvs_device_limits &limits);
  void take_velocity(const mvs_driver_state &sample, const Vec3 &step);
  void take_spin(const Eigen::Quaterniond &before, const mvs_device_limits &limits);
  void latch_cause(Cause cause) {
    if (cause_ == Cause::nothing) cause_ = cause;
  }

  const DeviceTraits *traits_;
  HandPose pose_;
  bool has_pose_ = false, has_time_ = false;  // of a finite sample
  uint64_t time_ns_ = 0, sequence_ = 0;
  double dt_ = 0, passed_ = 0, silent_ = 0;  // s
  double still_ = 0;                         // s, since the time of new samples advanced
  uint32_t fast_ = 0, fast_turns_ = 0;       // consecutive samples above the speed limit
  Cause cause_ = Cause::nothing;
  uint32_t flags_ = 0, faults_ = 0;
};

// Debounces buttons. A button that is down at the start counts as stuck until it was up once.
class Buttons {
 public:
  // Returns whether a debounced button changed.
  bool take(uint32_t raw, double dt);
  void start() { *this = Buttons(); }
  uint32_t down() const { return steady_ & ~stuck_; }

 private:
  bool first_ = true;
  uint32_t steady_ = 0, stuck_ = 0;
  std::array<double, 32> since_ = {};  // s since each button differs from its debounced state
};

}  // namespace mvs::core
