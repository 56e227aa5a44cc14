// Force limits: motor heat budget, workspace wall, norm clamp.
#pragma once

#include "haptics/servo_types.h"

namespace mvs::core {

// First-order thermal model of the motors: heat is the running mean (time constant thermal_s) of
// the squared force over the squared continuous force. The force limit falls from the peak force at
// heat 0 to the continuous force at heat 1, so that a sustained force settles at the continuous
// force.
class HeatBudget {
 public:
  void spend(const Vec3 &force, double dt, const mvs_device_limits &limits) {
    heat_ += dt / (limits.thermal_s + dt) * (force.squaredNorm() / square(limits) - heat_);
  }
  // Returns the force limit, N. Motors that report a warm flag get the continuous force.
  double most(const mvs_device_limits &limits, bool is_warm) const {
    const double cool = is_warm ? 0 : std::max(0.0, 1 - heat_);
    const double peak = limits.force * limits.force;
    return std::sqrt(square(limits) + (peak - square(limits)) * cool);
  }
  double heat() const { return heat_; }  // 1: steady state at the continuous force

 private:
  static double square(const mvs_device_limits &limits) {
    return limits.continuous_force * limits.continuous_force;
  }
  double heat_ = 0;
};

// Returns the force of a spring wall that pushes the hand back into the workspace box. The wall
// begins at a margin inside the faces.
Vec3 workspace_wall(const DeviceTraits &traits, const Vec3 &hand);

// Returns the force shortened to the norm `most`; sets `bit` in `limited` if it was longer.
Vec3 clamped(const Vec3 &force, double most, uint32_t bit, uint32_t &limited);

}  // namespace mvs::core
