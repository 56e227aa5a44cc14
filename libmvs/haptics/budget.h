// How strong a force may be, and how fast it may change.
#pragma once

#include "haptics/servo_types.h"

namespace mvs::core {

// Motors heat with the square of the force: a running mean of it stays below the square of the
// continuous force. The limit falls from the peak, when cool, to the continuous force, when hot;
// there heat and limit meet, so that the force comes to rest at what the motors bear for ever.
class HeatBudget {
 public:
  void spend(const Vec3 &force, double dt, const mvs_device_limits &limits) {
    heat_ += dt / (limits.thermal_s + dt) * (force.squaredNorm() / square(limits) - heat_);
  }
  // N.
  double most(const mvs_device_limits &limits, bool is_warm) const {
    const double cool = is_warm ? 0 : std::max(0.0, 1 - heat_);
    const double peak = limits.force * limits.force;
    return std::sqrt(square(limits) + (peak - square(limits)) * cool);
  }
  double heat() const { return heat_; }  // 1: as warm as the continuous force makes them

 private:
  static double square(const mvs_device_limits &limits) {
    return limits.continuous_force * limits.continuous_force;
  }
  double heat_ = 0;
};

// Pushes the hand back into the box where the device reaches, from a margin inside its faces on.
Vec3 workspace_wall(const DeviceTraits &traits, const Vec3 &hand);

// The force, no longer than `most`; sets a bit of `limited` if it was.
Vec3 clamped(const Vec3 &force, double most, uint32_t bit, uint32_t &limited);

}  // namespace mvs::core
