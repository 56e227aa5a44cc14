// Evaluation of the local tissue model.
#include "haptics/tissue_model.h"

namespace mvs::core {
namespace {

Vec3 shortened(const Vec3 &force, double most) {
  const double size = force.norm();
  return size > most ? Vec3(most / size * force) : force;
}

}  // namespace

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

double work_to(const TissueModel &t, const Vec3 &hand) {
  return 0.5 * (force_at(t, t.origin) + force_at(t, hand)).dot(hand - t.origin);
}

}  // namespace mvs::core
