// The account of what the loop makes.
#include "haptics/energy.h"

#include <algorithm>

namespace mvs::core {

// What the loop took out of its own is not saved for later: a store could be spent all at once.
void EnergyObserver::take_step(const Vec3 &step, const std::array<Vec3, 2> &told,
                               const Vec3 &before, const Vec3 &now) {
  const double given = std::max(told[0].dot(step), told[1].dot(step));
  energy_ = std::max(0.0, energy_ + given - 0.5 * (before + now).dot(step));
}

// The old model said that it worked W_old on the way from its origin to here. The simulation worked
// between the two origins, the new model from there to here.
void EnergyObserver::take_model(const TissueModel &before, const TissueModel &now, const Vec3 &hand,
                                double share) {
  const double simulated = 0.5 * (before.force + now.force).dot(now.origin - before.origin);
  const double made = work_to(before, hand) - simulated - work_to(now, hand);
  energy_ = std::max(0.0, energy_ + share * made);
}

Vec3 EnergyObserver::damp(const Vec3 &velocity, double dt, double most) const {
  const double square = velocity.squaredNorm();
  if (energy_ <= 0 || square == 0) return Vec3::Zero();
  return -std::min(most, energy_ / (square * dt)) * velocity;
}

}  // namespace mvs::core
