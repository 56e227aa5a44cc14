// Distance of two convex hulls by the algorithm of Gilbert, Johnson and Keerthi (IEEE J. Robotics
// Automation 4, 1988), with the corners that the closest points lie between.
//
// The input are points whose hull is meant; points inside the hull do no harm. The result is exact
// up to rounding for hulls that are apart: the loop ends at the feature of the difference of both
// hulls that is closest to the origin. Where the hulls meet, the distance is 0.
#pragma once

#include <span>

#include "base/types.h"
#include "geometry/convex_hull.h"

namespace mvs::core {

// Closest points of hulls a and b: sum_k weight[k] a[first[k]] and sum_k weight[k] b[second[k]].
struct ConvexDistance {
  uint32_t count = 0;  // corners of the difference, 1 to 3; 0 where the hulls meet
  std::array<uint32_t, 3> first{}, second{};
  std::array<double, 3> weight{};
  Vec3 apart = Vec3::Zero();  // from b to a, its length is `distance`
  double distance = 0;        // m
  bool is_beyond = false;     // the hulls are farther apart than `cutoff`; only `distance` and
                              // `apart` hold then, and are of a pair of points, not the closest
};

// Stops as soon as a plane shows that the hulls are farther apart than `cutoff`. `edges`: of the
// hull of a (lowest_corner()).
ConvexDistance convex_distance(std::span<const Vec3> a, std::span<const Vec3> b, double cutoff,
                               const HullEdges *edges = nullptr);

// Returns whether a plane shows that the hulls are farther apart than `margin`, above 0 m. It is
// the loop of convex_distance(), ended as soon as a plane or a pair of points decides; where
// rounding decides, the hulls are not apart. `guess`: a direction from b to a in which the gap may
// be widest; a good one saves turns and changes nothing else.
bool are_apart(std::span<const Vec3> a, std::span<const Vec3> b, double margin, const Vec3 &guess);

// Returns the width of the gap between the planes normal to the unit vector n that touch a and b:
// min n a - max n b, exact up to the rounding of one product. Above 0 the hulls are apart, whatever
// found n.
double plane_gap(std::span<const Vec3> a, std::span<const Vec3> b, const Vec3 &n);

}  // namespace mvs::core
