// Longest-edge bisection of a triangle mesh where its edges are too long.
#pragma once

#include <functional>
#include <vector>

#include "base/types.h"

namespace mvs::core::orifice {

struct Mesh {
  std::vector<Vec3> x;
  std::vector<Tri> triangles;
};

double area_of(const Mesh &mesh);

// Returns triangles over `points` as a mesh of their own nodes, in the order of their first use.
Mesh compact_mesh(const std::vector<Vec3> &points, const std::vector<Tri> &triangles);

// The edge that a refinement criterion gets.
struct BisectEdge {
  Vec3 a, b;
  Vec3 normal;  // sum of the area vectors of its triangles
  bool on_rim;  // the edge belongs to one triangle only
};

// Halves edges until no edge is too long. A triangle is always divided at its longest edge first,
// which keeps its angles above half of the smallest initial one (Rosenberg, Stenger 1975). Old
// nodes keep their numbers and positions.
void bisect(Mesh &mesh, const std::function<bool(const BisectEdge &)> &is_too_long);

}  // namespace mvs::core::orifice
