// Convex hull of points in space, by incremental insertion with exact predicates (de Berg et al.,
// Computational Geometry, 2008, chapter 11).
#pragma once

#include <vector>

#include "base/types.h"

namespace mvs::core {

struct ConvexHull {
  std::vector<uint32_t> corners;  // points that are corners of the hull, ascending
  std::vector<Tri> faces;         // triangles over all points, with outward normals
};

// Returns the hull of points; empty if all of them lie within `thinnest` times their extent of one
// plane. Points on a face or edge of the hull are not corners, unless a triangle needs them.
ConvexHull convex_hull(const std::vector<Vec3> &points, double thinnest = 1e-6);

}  // namespace mvs::core
