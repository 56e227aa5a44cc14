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
  const std::vector<Vec3> &rim;               // the annulus
  std::function<bool(const Vec3 &)> is_open;  // whether no tissue is seen there from above
};

// Rolls a ball down from each start, along a path on which it neither enters the leaflets nor
// leaves the annulus with its centre, until it can go no lower. Returns the lowest points of the
// ball there, the lowest first.
//
// In each step the distance to a triangle is replaced by that to the plane through its closest
// point, which is no greater as triangles are convex; the lowest place that all planes leave to the
// centre is the solution of a linear program. At a place that three triangles determine this is
// Newton's method: exact up to rounding.
//
// A ball that falls through an opening does not count, but vertices of free edges beside which it
// passes do: a radius below them, as is the ball when it leaves the tissue.
std::vector<Vec3> lows_of_ball(const SheetFromAbove &sheet, const std::vector<Vec3> &starts,
                               double radius);

}  // namespace mvs::core
