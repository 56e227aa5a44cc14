// Making the triangles of a sheet smaller where they are too large.
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

// An edge as the criterion sees it.
struct BisectEdge {
  Vec3 a, b;
  Vec3 normal;  // sum of the area vectors of its triangles
  bool on_rim;  // it belongs to one triangle only
};

// Halves edges until none is too long. A triangle is always cut through its longest edge first,
// which keeps its angles above half of the smallest it started with (Rosenberg, Stenger 1975).
// Old nodes keep their numbers and places.
void bisect(Mesh &mesh, const std::function<bool(const BisectEdge &)> &is_too_long);

}  // namespace mvs::core::orifice
