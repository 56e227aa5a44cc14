// Evaluation of the local tissue model.
#include "haptics/tissue_model.h"

#include <algorithm>

namespace mvs::core {
namespace {

Vec3 shortened(const Vec3 &force, double most) {
  const double size = force.norm();
  return size > most ? Vec3(most / size * force) : force;
}

// The shorter rotation from one orientation to another.
Eigen::Quaterniond turn_between(const Eigen::Quaterniond &from, const Eigen::Quaterniond &to) {
  Eigen::Quaterniond turn = to * from.conjugate();
  if (turn.w() < 0) turn.coeffs() = -turn.coeffs();
  return turn;
}

// Force and negative derivative of the energy by the coordinate p = 2 v of the rotation `turn`.
Wrench generalised_at(const TissueModel &t, const Vec3 &hand, const Eigen::Quaterniond &turn) {
  if (t.turns == 0 || t.kind == TissueModel::pulled) return {force_at(t, hand), Vec3::Zero()};
  const Vec3 away = hand - t.origin, p = 2 * turn.vec();
  if (t.kind == TissueModel::near) {
    const Vec3 tilt = t.arm.cross(t.normal);
    const double depth = -t.normal.dot(away) - tilt.dot(p) - t.gap;
    if (!(depth > 0)) return {};
    const double size = std::min(t.normal.dot(t.stiffness * t.normal) * depth, t.most);
    return {size * t.normal, shortened(size * tilt, t.most_torque)};
  }
  if (t.kind != TissueModel::held && t.kind != TissueModel::touched) return {};
  const Vec3 force = t.force - t.stiffness * away - t.coupling * p;
  const Vec3 torque = t.torque - t.coupling.transpose() * away - t.turning * p;
  if (t.kind == TissueModel::touched) {
    const double along = t.lever * t.lever * force.dot(t.force) + torque.dot(t.torque);
    if (!(along > 0)) return {};
  }
  return {shortened(force, t.most), shortened(torque, t.most_torque)};
}

}  // namespace

TissueModel scaled(const TissueModel &tissue, double share) {
  TissueModel out = tissue;
  out.force *= share;
  out.stiffness *= share;
  out.most *= share;
  out.torque *= share;
  out.coupling *= share;
  out.turning *= share;
  out.most_torque *= share;
  return out;
}

Vec3 force_at(const TissueModel &t, const Vec3 &hand) {
  const Vec3 away = hand - t.origin;
  switch (t.kind) {
    case TissueModel::held:
      return shortened(t.force - t.stiffness * away, t.most);
    case TissueModel::touched: {
      const Vec3 force = t.force - t.stiffness * away;
      return force.dot(t.force) > 0 ? shortened(force, t.most) : Vec3::Zero();
    }
    case TissueModel::near: {
      const double depth = -t.normal.dot(away) - t.gap;
      if (!(depth > 0)) return Vec3::Zero();
      return shortened(t.stiffness * t.normal * depth, t.most);
    }
    case TissueModel::pulled:
      return shortened(t.force, t.most);
    default:
      return Vec3::Zero();
  }
}

// The torque is not longer than that of g, as this is orthogonal to v x g and w^2 + |v|^2 = 1.
Wrench wrench_at(const TissueModel &t, const Placement &hand) {
  if (t.turns == 0) return {force_at(t, hand.position), Vec3::Zero()};
  const Eigen::Quaterniond turn = turn_between(t.orientation, hand.orientation);
  const Wrench g = generalised_at(t, hand.position, turn);
  return {g.force, turn.w() * g.torque + turn.vec().cross(g.torque)};
}

double work_to(const TissueModel &t, const Placement &hand) {
  const Vec3 away = hand.position - t.origin;
  if (t.turns == 0) return 0.5 * (force_at(t, t.origin) + force_at(t, hand.position)).dot(away);
  const Eigen::Quaterniond turn = turn_between(t.orientation, hand.orientation);
  const Wrench begin = generalised_at(t, t.origin, Eigen::Quaterniond::Identity());
  const Wrench end = generalised_at(t, hand.position, turn);
  return 0.5 * (begin.force + end.force).dot(away) +
         (begin.torque + end.torque).dot(turn.vec());  // half of p
}

Vec3 small_rotation(const Eigen::Quaterniond &from, const Eigen::Quaterniond &to) {
  const Vec3 v = turn_between(from, to).vec();
  return 2 * (1 + v.squaredNorm() / 6) * v;
}

}  // namespace mvs::core
