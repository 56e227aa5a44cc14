// Convex hull of points in space, by incremental insertion with exact predicates (de Berg et al.,
// Computational Geometry, 2008, chapter 11).
#pragma once

#include <span>
#include <vector>

#include "base/types.h"

namespace mvs::core {

struct ConvexHull {
  std::vector<uint32_t> corners;  // points that are corners of the hull, ascending
  std::vector<Tri> faces;         // triangles over all points, with outward normals
};

// The edges of the surface of a hull: the neighbours of point k are to[start[k]] .. to[start[k +
// 1]].
struct HullEdges {
  std::vector<uint32_t> start, to;
  uint32_t first = 0;  // a corner

  bool empty() const { return to.empty(); }
};
// `points`: their number; those on no face have no neighbours.
HullEdges hull_edges(const std::vector<Tri> &faces, size_t points);

// Returns the first of the points that are lowest along n.
uint32_t lowest_point(std::span<const Vec3> points, const Vec3 &n);

// Returns a corner that is lowest along n, found by descent from the corner `from` on, from
// neighbour to neighbour: a hull has no other minimum. Looks at all points if `edges` is null or
// empty.
uint32_t lowest_corner(const HullEdges *edges, std::span<const Vec3> points, const Vec3 &n,
                       uint32_t from);

// Returns the hull of points; empty if all of them lie within `thinnest` times their extent of one
// plane. Points on a face or edge of the hull are not corners, unless a triangle needs them.
ConvexHull convex_hull(const std::vector<Vec3> &points, double thinnest = 1e-6);

}  // namespace mvs::core
