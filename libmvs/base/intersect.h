// Do two triangles cross? Exact: the signs are those of real arithmetic on the given doubles.
#pragma once

#include <cstddef>
#include <vector>

#include "base/types.h"

namespace mvs {

// The sign (-1, 0, 1) of the volume of tetrahedron a b c d, exact.
int orient3d_sign(const Vec3 &a, const Vec3 &b, const Vec3 &c, const Vec3 &d);

// Whether segment p q passes through triangle a b c (touching counts), exact.
bool segment_crosses_triangle(const Vec3 &p, const Vec3 &q, const Vec3 &a, const Vec3 &b,
                              const Vec3 &c);

// Pairs of triangles without a common node that cross. Neighbours that share one node count when
// the opposite edge of one passes through the other.
std::vector<Edge> find_intersections(const std::vector<Vec3> &x, const std::vector<Tri> &triangles);

}  // namespace mvs
