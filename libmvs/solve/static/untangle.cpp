// Pushes crossing triangles apart, in the direction that their places on the coarse sheet give.
#include "solve/static/untangle.h"

#include <utility>

#include "geometry/intersect.h"
#include "solve/hierarchy_settings.h"

namespace mvs::core {
namespace {

Vec3 on_coarse_sheet(const LevelPlace &place, const std::vector<Vec3> &x) {
  Vec3 sum = Vec3::Zero();
  for (int k = 0; k < 3; ++k) sum += place.weight[k] * x[place.nodes[k]];
  return sum;
}

Vec3 centre(const Tri &t, const LevelMap &map, const std::vector<Vec3> &coarse_x) {
  Vec3 sum = Vec3::Zero();
  for (const uint32_t node : t) sum += on_coarse_sheet(map.place[node], coarse_x);
  return sum / 3;
}

// The sum of the directions in which its crossing triangles push each node, of length 1.
std::vector<Vec3> pushes(const std::vector<Edge> &crossings, const LevelMap &map,
                         const std::vector<Vec3> &coarse_x, const Model &fine) {
  std::vector<Vec3> push(map.place.size(), Vec3::Zero());
  for (const auto &[first, second] : crossings) {
    const Tri &a = fine.valve.triangles[first], &b = fine.valve.triangles[second];
    const Vec3 apart = centre(a, map, coarse_x) - centre(b, map, coarse_x);
    if (!(apart.norm() > 0)) continue;
    for (const uint32_t node : a) push[node] += apart / apart.norm();
    for (const uint32_t node : b) push[node] -= apart / apart.norm();
  }
  for (size_t i = 0; i < push.size(); ++i) {
    const double length = push[i].norm();
    if (fine.topology.fixed[i] || !(length > 0)) {
      push[i].setZero();
    } else {
      push[i] /= length;
    }
  }
  return push;
}

}  // namespace

Untangled untangle(const LevelMap &map, const std::vector<Vec3> &coarse_x, const Model &fine,
                   std::vector<Vec3> &x) {
  namespace set = settings::untangle;
  std::vector<Edge> crossings = find_intersections(x, fine.valve.triangles);
  Untangled done{crossings.size(), crossings.size()};
  if (crossings.empty() || crossings.size() > set::max_crossings) return done;
  const double increment = set::increment * fine.valve.contact_thickness;
  std::vector<Vec3> moved = x;
  for (uint32_t round = 0; round < set::rounds && !crossings.empty(); ++round) {
    const std::vector<Vec3> push = pushes(crossings, map, coarse_x, fine);
    for (size_t i = 0; i < moved.size(); ++i) moved[i] += increment * push[i];
    crossings = find_intersections(moved, fine.valve.triangles);
  }
  done.left = crossings.size();
  if (crossings.empty()) x = std::move(moved);
  return done;
}

}  // namespace mvs::core
