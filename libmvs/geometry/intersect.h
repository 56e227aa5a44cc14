// Do two triangles cross? Exact: the signs are those of real arithmetic on the given doubles
// (finite, and of a size that base/expansion.h can hold).
#pragma once

#include <cstddef>
#include <vector>

#include "base/types.h"

namespace mvs::core {

// The sign (-1, 0, 1) of the volume of tetrahedron a b c d, exact: 1 when d lies on the side of
// triangle a b c that its normal (b - a) x (c - a) points to.
int orient3d_sign(const Vec3 &a, const Vec3 &b, const Vec3 &c, const Vec3 &d);

// Whether segment p q passes through triangle a b c, exact. Touching counts; the segment may be a
// point or lie in the triangle's plane, the triangle may be flat (a segment or a point).
bool segment_crosses_triangle(const Vec3 &p, const Vec3 &q, const Vec3 &a, const Vec3 &b,
                              const Vec3 &c);

// Whether two triangles have a point in common, exact, under the same conditions.
bool triangles_cross(const std::array<Vec3, 3> &first, const std::array<Vec3, 3> &second);

// Pairs of triangles that cross, smaller number first, sorted.
// - No common node: they cross when they have a point in common; touching counts.
// - One common node: when the side of one that lies opposite to it passes through the other.
// - A common edge: only when exactly folded onto each other, that is, coplanar with both third
//   corners strictly on the same side: then two layers of tissue are in one place.
// - The same three nodes: when the triangle is not flat.
std::vector<Edge> find_intersections(const std::vector<Vec3> &x, const std::vector<Tri> &triangles);

}  // namespace mvs::core
