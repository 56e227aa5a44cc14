// Collects triangles by the distance of their boxes.
#include "geometry/closest_nearby.h"

#include <algorithm>
#include <cmath>

namespace mvs::core {
namespace {

// Above the rounding of the distances that decide which triangles are collected.
constexpr double with_rounding = 1 + 1e-9;

}  // namespace

double nearby_limit2(double distance2, double radius) {
  const double limit = (std::sqrt(distance2) + 2 * radius) * with_rounding;
  return limit * limit;
}

uint32_t list_nearby(const TriangleBvh &tree, const std::vector<uint32_t> &among,
                     const Vec3 &centre, double radius, std::vector<NearTriangle> &near) {
  near.clear();
  uint32_t nearest = none;
  double least = HUGE_VAL, limit2 = HUGE_VAL;
  for (const uint32_t t : among) {
    if (tree.box_of(t).distance2(centre) > limit2) continue;
    const double distance2 = tree.closest_on(t, centre).distance2;
    if (distance2 > limit2) continue;
    near.push_back({t, distance2});
    if (distance2 > least || (distance2 == least && t > nearest)) continue;
    least = distance2;
    nearest = t;
    limit2 = nearby_limit2(least, radius);
  }
  near.erase(std::remove_if(near.begin(), near.end(),
                            [&](const NearTriangle &n) { return n.distance2 > limit2; }),
             near.end());
  return nearest;
}

ClosestNearby::ClosestNearby(const TriangleBvh &tree, const Vec3 &centre, double radius,
                             uint32_t hint)
    : tree_(tree) {
  const TriangleBvh::Hit hit = tree.closest(centre, hint);
  first_ = hit.triangle;
  const double limit2 = nearby_limit2(hit.distance2, radius);
  tree.visit_near(centre, limit2, [&](uint32_t t) {
    if (tree.box_of(t).distance2(centre) <= limit2) triangles_.push_back(t);
  });
}

TriangleBvh::Hit ClosestNearby::closest(const Vec3 &p, uint32_t hint) const {
  ClosestSoFar best(tree_, p);
  if (hint != none) best.look_at(hint);
  for (const uint32_t t : triangles_) best.look_at(t);
  return best.hit();
}

}  // namespace mvs::core
