// Workspace wall and norm clamp.
#include "haptics/force_limits.h"

#include <algorithm>
#include <cmath>

namespace mvs::core {
namespace {

constexpr double margin = 5e-3;         // m, from the face of the box to the wall...
constexpr double margin_share = 0.05;   // ...at most this share of the width of the box
constexpr double wall_stiffness = 0.5;  // share of the largest stiffness

}  // namespace

Vec3 workspace_wall(const DeviceTraits &traits, const mvs_device_limits &limits, const Vec3 &hand) {
  Vec3 force = Vec3::Zero();
  if (!traits.has_workspace) return force;
  const double stiffness = wall_stiffness * limits.stiffness;
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
