// Distance of a triangle from a vertical half-line.
#pragma once

#include <array>
#include <limits>

#include "geometry/distance.h"

namespace mvs::core {

// The point of a triangle closest to the half-line from `from` upwards: the squared distance, and
// the vector from there to the half-line.
struct AxisPoint {
  double distance2;
  Vec3 away;
};

inline AxisPoint closest_to_axis(const std::array<Vec3, 3> &corner, const Vec3 &from) {
  const auto point = [](const std::array<double, 3> &weight, const Vec3 &a, const Vec3 &b,
                        const Vec3 &c) {
    return Vec3(weight[0] * a + weight[1] * b + weight[2] * c);
  };
  AxisPoint found{std::numeric_limits<double>::infinity(), Vec3::Zero()};
  // seen from above, a triangle that is all above is nearer, or as near
  if (!(corner[0][2] > from[2] && corner[1][2] > from[2] && corner[2][2] > from[2])) {
    const TrianglePoint closest = closest_on_triangle(from, corner[0], corner[1], corner[2]);
    found = {closest.distance2, from - point(closest.weight, corner[0], corner[1], corner[2])};
  }
  // the part of the triangle above, seen from above
  std::array<Vec3, 4> part;
  size_t count = 0;
  const auto add = [&](const Vec3 &p) { part[count++] = Vec3(p[0], p[1], 0); };
  for (size_t k = 0; k < 3; ++k) {
    const Vec3 &a = corner[k], &b = corner[(k + 1) % 3];
    const double above_a = a[2] - from[2], above_b = b[2] - from[2];
    if (above_a > 0) add(a);
    if ((above_a > 0) != (above_b > 0)) add(a + above_a / (above_a - above_b) * (b - a));
  }
  const Vec3 at(from[0], from[1], 0);
  for (size_t k = 2; k < count; ++k) {
    const TrianglePoint flat = closest_on_triangle(at, part[0], part[k - 1], part[k]);
    if (!(flat.distance2 < found.distance2)) continue;
    found = {flat.distance2, at - point(flat.weight, part[0], part[k - 1], part[k])};
  }
  return found;
}

}  // namespace mvs::core
