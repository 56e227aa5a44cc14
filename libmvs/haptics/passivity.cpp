// Energy account of the passivity observer.
#include "haptics/passivity.h"

#include <algorithm>

namespace mvs::core {
namespace {

// m/s and rad/s: at less than this along a wrench, the share that does work is reduced less.
constexpr double slow = 0.01, slow_spin = 0.2;

double work_over(const Wrench &wrench, const Twist &step) {
  return wrench.force.dot(step.linear) + wrench.torque.dot(step.angular);
}

Wrench sum_of(const Wrench &a, const Wrench &b) {
  return {a.force + b.force, a.torque + b.torque};
}

}  // namespace

// The energy is clamped at 0: a store of dissipated energy could be released at once later.
void EnergyObserver::take_step(const Twist &step, const std::array<Wrench, 2> &sent,
                               const Wrench &before, const Wrench &now) {
  const double given = std::max(work_over(sent[0], step), work_over(sent[1], step));
  energy_ = std::max(0.0, energy_ + given - 0.5 * work_over(sum_of(before, now), step));
}

// The old model did the work W_old from its origin to the hand. The consistent value is the work of
// the simulation between the two origins plus that of the new model from its origin to the hand.
void EnergyObserver::take_model(const TissueModel &before, const TissueModel &now,
                                const Placement &hand, double share) {
  Twist moved = {now.origin - before.origin, Vec3::Zero()};
  if (before.turns != 0 && now.turns != 0)
    moved.angular = small_rotation(before.orientation, now.orientation);
  const Wrench both = sum_of({before.force, before.torque}, {now.force, now.torque});
  const double simulated = 0.5 * work_over(both, moved);
  const double made = work_to(before, hand) - simulated - work_to(now, hand);
  energy_ = std::max(0.0, energy_ + share * made);
}

Wrench EnergyObserver::damp(const Twist &velocity, double dt, const Damping &most) const {
  const double ratio = most.angular / most.linear;  // m2
  const double square = velocity.linear.squaredNorm() + ratio * velocity.angular.squaredNorm();
  if (energy_ <= 0 || square == 0) return {};
  const double damping = std::min(most.linear, energy_ / (square * dt));
  return {-damping * velocity.linear, -damping * ratio * velocity.angular};
}

double EnergyObserver::working_share(const Wrench &wrench, const Twist &velocity,
                                     double most) const {
  const double power = work_over(wrench, velocity);
  if (energy_ <= most || power <= 0) return 1;
  const double surplus = std::min(1.0, (energy_ - most) / most);
  const double slow_power = slow * wrench.force.norm() + slow_spin * wrench.torque.norm();
  return 1 - surplus * std::min(1.0, power / slow_power);
}

}  // namespace mvs::core
