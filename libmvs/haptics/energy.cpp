// Energy account of the passivity observer.
#include "haptics/energy.h"

#include <algorithm>

namespace mvs::core {

// The energy is clamped at 0: a store of dissipated energy could be released at once later.
void EnergyObserver::take_step(const Vec3 &step, const std::array<Vec3, 2> &sent,
                               const Vec3 &before, const Vec3 &now) {
  const double given = std::max(sent[0].dot(step), sent[1].dot(step));
  energy_ = std::max(0.0, energy_ + given - 0.5 * (before + now).dot(step));
}

// The old model did the work W_old from its origin to the hand. The consistent value is the work of
// the simulation between the two origins plus that of the new model from its origin to the hand.
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
