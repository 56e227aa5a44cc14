// Linear program in three dimensions: the lowest point of an intersection of half-spaces.
#pragma once

#include <vector>

#include "base/types.h"

namespace mvs::core {

// The points p with normal . p >= offset. The normal is a unit vector.
struct HalfSpace {
  Vec3 normal;
  double offset;
};

// Returns the point with the least third coordinate of those that lie in all half-spaces and whose
// coordinates are at most `reach` from 0: the incremental algorithm of Seidel (Small-dimensional
// linear programming and convex hulls made easy, Discrete & Computational Geometry 6, 1991), in the
// order of the list. The origin has to lie in all of them. Exact up to rounding; of several
// points, one is chosen by the order. Returns the origin where rounding leaves no point.
Vec3 lowest_point(const std::vector<HalfSpace> &half_spaces, double reach);

}  // namespace mvs::core
