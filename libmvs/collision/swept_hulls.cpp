// Corners of the hulls. The gap in the middle of the motion is the first direction to be tried.
#include "collision/swept_hulls.h"

#include <span>

#include "geometry/convex_distance.h"
#include "geometry/distance.h"

namespace mvs::core {
namespace {

struct HullCorners {
  std::array<Vec3, 8> at;
  size_t count = 0;

  void add(const Vec3 &place) { at[count++] = place; }
  operator std::span<const Vec3>() const { return {at.data(), count}; }
};

HullCorners swept_corners(const NodeMotion &motion, std::span<const uint32_t> nodes) {
  HullCorners corners;
  for (const uint32_t i : nodes) {
    corners.add(motion.from[i]);
    corners.add(motion.to[i]);
  }
  return corners;
}

bool keep_apart(const NodeMotion &motion, std::span<const uint32_t> a, std::span<const uint32_t> b,
                double margin, const Vec3 &gap) {
  if (motion.is_independent()) {
    return are_apart(swept_corners(motion, a), swept_corners(motion, b), margin, gap);
  }
  HullCorners differences;
  for (const uint32_t i : a) {
    for (const uint32_t j : b) {
      differences.add(motion.from[i] - motion.from[j]);
      differences.add(motion.to[i] - motion.to[j]);
    }
  }
  const Vec3 origin = Vec3::Zero();
  return are_apart(differences, {&origin, 1}, margin, gap);
}

}  // namespace

bool keep_apart(const NodeMotion &motion, uint32_t vertex, const Tri &triangle, double margin) {
  const Vec3 &p = motion.middle[vertex], &a = motion.middle[triangle[0]],
             &b = motion.middle[triangle[1]], &c = motion.middle[triangle[2]];
  const auto [u, v, w] = closest_on_triangle(p, a, b, c).weight;
  return keep_apart(motion, {&vertex, 1}, triangle, margin, p - u * a - v * b - w * c);
}

bool keep_apart(const NodeMotion &motion, const Edge &e, const Edge &f, double margin) {
  const Vec3 &a = motion.middle[e[0]], &b = motion.middle[e[1]], &c = motion.middle[f[0]],
             &d = motion.middle[f[1]];
  const SegmentPair p = closest_of_segments(a, b, c, d);
  return keep_apart(motion, e, f, margin, a + p.s * (b - a) - c - p.t * (d - c));
}

}  // namespace mvs::core
