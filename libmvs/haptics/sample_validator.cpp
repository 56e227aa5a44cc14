// Checks of samples, velocity estimate, button debounce.
#include "haptics/sample_validator.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace mvs::core {
namespace {

constexpr double sample_timeout = 1e-3 * MVS_DRIVER_PATIENCE_MS;  // s, without a new sample
constexpr double max_coordinate = 10;                             // m
// Share of the device's period: a clock that moves by less from sample to sample stands still. One
// that counts us where ns are meant moves by a thousandth.
constexpr double creep = 2e-3;
constexpr double jump = 5;                // times the speed limit, in one sample
constexpr uint32_t fast_samples = 3;      // consecutive, above the speed limit
constexpr double velocity_filter = 5e-3;  // s, time constant of the velocity estimate
constexpr double bounce = 10e-3;          // s, debounce time of a button

constexpr double max_speed = 1e3;  // m/s, of a measured velocity
constexpr double plausible = 1;    // m, from the centre; no haptic device reaches farther

bool is_number(double value, double most) {
  return std::abs(value) <= most;  // false for NaN
}

bool is_unit(const double *q) {
  const double square = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3];
  return std::abs(square - 1) < 1e-3;
}

}  // namespace

void SampleValidator::start() {
  const DeviceTraits *const traits = traits_;
  *this = SampleValidator(*traits);
}

void SampleValidator::take(const mvs_driver_state &sample, const mvs_device_limits &limits) {
  cause_ = Cause::nothing;
  flags_ = sample.flags;
  find_faults(sample);
  if (!is_usable(sample)) {
    dt_ = passed_ = 0;
    return latch_cause(Cause::not_finite);
  }
  take_time(sample);
  latch_cause(std::min(static_cast<Cause>(sample.cause), Cause::calibration));
  if (!(flags_ & MVS_DRIVER_FLAG_CALIBRATED)) latch_cause(Cause::calibration);
  if (traits_->has_deadman && !(flags_ & MVS_DRIVER_FLAG_HELD)) latch_cause(Cause::deadman);
  if (silent_ > sample_timeout) latch_cause(Cause::watchdog);
  if (faults_ & MVS_SAMPLE_FAULT_FAR) {
    // the last place stays: the step to a place where no hand can be is no motion
    dt_ = 0;
    return latch_cause(Cause::calibration);
  }
  if (dt_ > 0 || !has_pose_) take_pose(sample, limits);
}

// Names the defects of one sample; take_time adds those of its clock.
void SampleValidator::find_faults(const mvs_driver_state &sample) {
  faults_ = is_unit(sample.orientation) ? 0 : MVS_SAMPLE_FAULT_ORIENTATION;
  const Vec3 position = traits_->turn * Vec3::Map(sample.position) + traits_->shift;
  bool finite = position.allFinite();
  if (finite && position.norm() > plausible) faults_ |= MVS_SAMPLE_FAULT_FAR;
  if (flags_ & MVS_DRIVER_FLAG_VELOCITY) {
    for (const double v : sample.velocity) finite = finite && is_number(v, max_speed);
  }
  if (!finite) faults_ |= MVS_SAMPLE_FAULT_NUMBER;
}

// After find_faults, which has looked at orientation and velocity.
bool SampleValidator::is_usable(const mvs_driver_state &sample) const {
  bool good = (faults_ & (MVS_SAMPLE_FAULT_NUMBER | MVS_SAMPLE_FAULT_ORIENTATION)) == 0;
  for (const double p : sample.position) good = good && is_number(p, max_coordinate);
  return good;
}

// Latches Cause::watchdog if the device's clock goes back or stands still.
void SampleValidator::take_time(const mvs_driver_state &sample) {
  dt_ = passed_ = 0;
  if (has_time_ && sample.time_ns < time_ns_) {
    time_ns_ = sample.time_ns;
    faults_ |= MVS_SAMPLE_FAULT_CLOCK;
    return latch_cause(Cause::watchdog);
  }
  passed_ = has_time_ ? 1e-9 * static_cast<double>(sample.time_ns - time_ns_) : 0;
  time_ns_ = sample.time_ns;
  const bool stands = passed_ <= creep / traits_->info.rate;
  if (!stands) still_ = 0;
  // if the clock stands still, ticks measure the silence
  silent_ += stands ? 1 / traits_->info.rate : passed_;
  if (std::exchange(has_time_, true) && sample.sequence == sequence_) {
    if (silent_ > sample_timeout) faults_ |= MVS_SAMPLE_FAULT_SEQUENCE;
    return;
  }
  if (stands) still_ += silent_;
  if (still_ > sample_timeout) {
    // without a time nothing moves or ages: forces would stay as they are
    faults_ |= MVS_SAMPLE_FAULT_CLOCK;
    latch_cause(Cause::watchdog);
  }
  sequence_ = sample.sequence;
  dt_ = stands ? 0 : silent_;
  if (silent_ > sample_timeout) latch_cause(Cause::watchdog);
  silent_ = 0;
}

void SampleValidator::take_pose(const mvs_driver_state &sample, const mvs_device_limits &limits) {
  const Vec3 before = pose_.position;
  const Eigen::Quaterniond turned = pose_.orientation;
  pose_.position = traits_->turn * Vec3::Map(sample.position) + traits_->shift;
  const double *const q = sample.orientation;
  pose_.orientation = traits_->turn_quaternion * Eigen::Quaterniond(q[0], q[1], q[2], q[3]);
  // work of torques needs more than the 1e-3 that is_unit() allows
  if (traits_->renders_torque) pose_.orientation.normalize();
  pose_.gripper = std::isfinite(sample.gripper) ? sample.gripper : 0;
  if (!has_pose_) {
    has_pose_ = true;
    return;
  }
  const Vec3 step = pose_.position - before;
  // samples delivered together by a busy computer must not look fast: at least half a period
  const double speed = step.norm() / std::max(dt_, 0.5 / traits_->info.rate);
  fast_ = speed > limits.speed ? fast_ + 1 : 0;
  if (speed > jump * limits.speed || fast_ >= fast_samples) latch_cause(Cause::velocity);
  if (speed > jump * limits.speed) {
    pose_.velocity = pose_.spin = Vec3::Zero();  // no motion: the estimate begins anew
    return;
  }
  take_velocity(sample, step);
  if (traits_->renders_torque) take_spin(turned, limits);
}

// Estimates the angular velocity; latches as for velocity. A jump of the orientation is as
// dangerous as one of the position: the torque follows it.
void SampleValidator::take_spin(const Eigen::Quaterniond &before, const mvs_device_limits &limits) {
  const Vec3 turn = small_rotation(before, pose_.orientation);
  const double speed = turn.norm() / std::max(dt_, 0.5 / traits_->info.rate);
  fast_turns_ = speed > limits.angular_speed ? fast_turns_ + 1 : 0;
  if (speed > jump * limits.angular_speed || fast_turns_ >= fast_samples)
    latch_cause(Cause::velocity);
  pose_.spin += dt_ / (velocity_filter + dt_) * (turn / dt_ - pose_.spin);
}

void SampleValidator::take_velocity(const mvs_driver_state &sample, const Vec3 &step) {
  if (flags_ & MVS_DRIVER_FLAG_VELOCITY) {
    pose_.velocity = traits_->turn * Vec3::Map(sample.velocity);
  } else {
    pose_.velocity += dt_ / (velocity_filter + dt_) * (step / dt_ - pose_.velocity);
  }
}

bool Buttons::take(uint32_t raw, double dt) {
  const uint32_t before = down();
  if (first_) stuck_ = steady_ = raw;
  first_ = false;
  for (uint32_t b = 0; b < 32; ++b) {
    const uint32_t bit = uint32_t{1} << b;
    since_[b] = ((raw ^ steady_) & bit) ? since_[b] + dt : 0;
    if (since_[b] < bounce) continue;
    steady_ ^= bit;
    stuck_ &= ~bit;
    since_[b] = 0;
  }
  return down() != before;
}

}  // namespace mvs::core
