// Walls and clamps.
#include "haptics/budget.h"

#include <algorithm>
#include <cmath>

namespace mvs::core {
namespace {

constexpr double margin = 5e-3;         // m, of the wall inside the box...
constexpr double margin_share = 0.05;   // ...but no more of its width than this
constexpr double wall_stiffness = 0.5;  // of the device's largest

}  // namespace

Vec3 workspace_wall(const DeviceTraits &traits, const Vec3 &hand) {
  Vec3 force = Vec3::Zero();
  if (!traits.has_workspace) return force;
  const double stiffness = wall_stiffness * traits.info.max_stiffness;
  for (int k = 0; k < 3; ++k) {
    const double low = traits.info.workspace_min[k], high = traits.info.workspace_max[k];
    const double inside = std::min(margin, margin_share * (high - low));
    force[k] = stiffness *
               (std::max(0.0, low + inside - hand[k]) - std::max(0.0, hand[k] - (high - inside)));
  }
  return force;
}

Vec3 clamped(const Vec3 &force, double most, uint32_t bit, uint32_t &limited) {
  const double size = force.norm();
  if (size <= most) return force;
  limited |= bit;
  return most / size * force;
}

}  // namespace mvs::core
