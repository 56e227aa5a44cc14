// Exact intersection tests of segments and triangles: the signs are those of real arithmetic on the
// given doubles (finite, and in the range of predicates.h).
#pragma once

#include <cstddef>
#include <vector>

#include "base/types.h"

namespace mvs::core {

struct BvhTopology;

// Returns the sign (-1, 0, 1) of the volume of tetrahedron a b c d: 1 if d is on the side of
// triangle a b c that its normal (b - a) x (c - a) points to.
int orient3d_sign(const Vec3 &a, const Vec3 &b, const Vec3 &c, const Vec3 &d);

// Returns whether segment p q and triangle a b c have a point in common. The segment may be a point
// or lie in the triangle's plane, the triangle may be flat (a segment or a point).
bool segment_crosses_triangle(const Vec3 &p, const Vec3 &q, const Vec3 &a, const Vec3 &b,
                              const Vec3 &c);

// Returns whether two triangles have a point in common, under the same conditions.
bool triangles_cross(const std::array<Vec3, 3> &first, const std::array<Vec3, 3> &second);

// Returns whether two triangles of a surface with vertices `x` cross. A pair crosses if
// - without a common node: the triangles have a point in common;
// - with one common node: the opposite side of one passes through the other;
// - with a common edge: they are folded onto each other, that is, coplanar with both third corners
//   strictly on the same side, so that two layers of tissue are in one place;
// - with the same three nodes: the triangle is not flat.
bool triangles_cross(const std::vector<Vec3> &x, const Tri &first, const Tri &second);

// Returns the pairs of triangles that cross, lower index first, sorted.
std::vector<Edge> find_intersections(const std::vector<Vec3> &x, const std::vector<Tri> &triangles);
// The same with a topology of these triangles, which saves its construction.
std::vector<Edge> find_intersections(const std::vector<Vec3> &x, const std::vector<Tri> &triangles,
                                     const BvhTopology &topology);

}  // namespace mvs::core
