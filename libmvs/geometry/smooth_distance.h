// Distance of a hull and a triangle or segment with a continuous derivative.
//
// The least distance has a kink where a facet or an edge of the hull is parallel to the part: the
// closest points jump from one end to the other. Here it is the least ratio
//   D = min over q in the part, p in the hull of (|q - p| - R) / m(q),
//   m = 1 + share (g / g_max - 1/2), g = 1 - sum_i weight_i^2, weight_i the coordinates of q,
// of a convex and a concave positive function that is strictly concave in the place q on the part.
// It has one minimum, so that D has a continuous derivative (Danskin's theorem) where the hull,
// rounded by R, and the part are apart. D is 0 where they touch, and lies between
// the least distance over 1 + share / 2 and over 1 - share / 2. A fractional
// programme: Dinkelbach, Management Science 13 (1967).
#pragma once

#include <span>

#include "geometry/convex_distance.h"

namespace mvs::core {

// q = sum_k weight[k] b[second[k]], p = sum_k weight[k] a[first[k]].
struct SmoothDistance {
  static constexpr uint32_t most_corners = 7;
  uint32_t count = 0;  // corners of the difference; 0 where the hulls meet
  std::array<uint32_t, most_corners> first{}, second{};
  std::array<double, most_corners> weight{};
  Vec3 apart = Vec3::Zero();  // p - q
  double distance = 0;        // m, |p - q|
  double factor = 1;          // m(q)
  double bend = 0;            // -d2m / dweight_i^2
  bool is_beyond = false;     // D is above `cutoff`; the rest is not set then
};

// `part`: up to 3 points. `edges`: see convex_distance(). A hull of one point has no kinks: its
// least distance is returned.
SmoothDistance smooth_distance(std::span<const Vec3> hull, std::span<const Vec3> part,
                               double radius, double share, double cutoff,
                               const HullEdges *edges = nullptr);

}  // namespace mvs::core
