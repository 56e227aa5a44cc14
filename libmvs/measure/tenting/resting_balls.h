// Places where a ball that is put on the leaflets from the atrium comes to rest.
#pragma once

#include <functional>
#include <vector>

#include "geometry/triangle_bvh.h"

namespace mvs::core {

// The leaflets in the frame of the valve: the third axis points into the atrium.
struct SheetFromAbove {
  const TriangleBvh &tree;
  const std::vector<Vec3> &x;
  const std::vector<std::vector<uint32_t>> &free_edges;
  const std::vector<Vec3> &rim;  // the annulus
  Aabb box;                      // of the leaflets
  // false where a ball with this centre cannot be let down from above, for tissue that is higher
  std::function<bool(const Vec3 &)> is_open;
};

// Centres from which balls roll down: those that are lower than others around them, and the others.
struct BallStarts {
  std::vector<Vec3> lowest, others;
};

// Moves a ball from the starts to places where it lies lower, until it can go no lower: local
// minima of the height at which it lies when it is let down from above, with its centre inside the
// annulus. Returns the lowest points of the ball there, the lowest first.
//
// The ball and the column above it are a capsule, which tissue may not enter. In each step the
// distance to a triangle is replaced by that to the plane through its closest point, which is no
// greater as both are convex; the lowest place that all planes leave to the centre is the solution
// of a linear program. At a place that three triangles determine this is Newton's method: exact up
// to rounding.
//
// A ball that falls through an opening does not count, but places of free edges beside which it
// passes do: a radius below them, as is the ball when it leaves the tissue.
std::vector<Vec3> lows_of_ball(const SheetFromAbove &sheet, BallStarts starts, double radius);

}  // namespace mvs::core
