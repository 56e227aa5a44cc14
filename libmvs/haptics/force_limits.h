// Force limits: motor heat budget, workspace wall, norm clamp.
#pragma once

#include "haptics/servo_types.h"

namespace mvs::core {

// Limits of some motors: N, or N m for those of the wrist; 0 without motors.
struct MotorLimits {
  double peak, continuous;
};
inline MotorLimits force_limits(const mvs_device_limits &limits) {
  return {limits.force, limits.continuous_force};
}
inline MotorLimits torque_limits(const mvs_device_limits &limits) {
  return {limits.torque, limits.continuous_torque};
}

// First-order thermal model of the motors: heat is the running mean (time constant thermal_s) of
// the squared force over the squared continuous force. The force limit falls from the peak force at
// heat 0 to the continuous force at heat 1, so that a sustained force settles at the continuous
// force. Motors for torque have a budget of their own.
class HeatBudget {
 public:
  void spend(const Vec3 &force, double dt, const MotorLimits &limits, double thermal_s) {
    if (limits.continuous <= 0) return;
    heat_ += dt / (thermal_s + dt) * (force.squaredNorm() / square(limits.continuous) - heat_);
  }
  // Returns the force limit. Motors that report a warm flag get the continuous force.
  double most(const MotorLimits &limits, bool is_warm) const {
    const double cool = is_warm ? 0 : std::max(0.0, 1 - heat_);
    const double low = square(limits.continuous);
    return std::sqrt(low + (square(limits.peak) - low) * cool);
  }
  double heat() const { return heat_; }  // 1: steady state at the continuous force

 private:
  static double square(double x) { return x * x; }
  double heat_ = 0;
};

// Returns the force of a spring wall that pushes the hand back into the workspace box. The wall
// begins at a margin inside the faces.
Vec3 workspace_wall(const DeviceTraits &traits, const mvs_device_limits &limits, const Vec3 &hand);

// Returns the force or torque shortened to the norm `most`; sets `bit` in `limited` if it was
// longer.
Vec3 clamped(const Vec3 &force, double most, uint32_t bit, uint32_t &limited);

}  // namespace mvs::core
