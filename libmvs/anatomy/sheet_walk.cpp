// Greedy descent of the distance over neighbouring triangles.
#include "anatomy/sheet_walk.h"

#include <cmath>

#include "geometry/distance.h"

namespace mvs::core {

void SheetWalk::look_around(uint32_t node, const Vec3 &p, uint32_t scallop,
                            Nearest &nearest) const {
  const std::vector<Vec3> &x = model_.valve.rest;
  for (const uint32_t t : model_.topology.node_triangles[node]) {
    if (scallop != none && model_.valve.triangle_scallop[t] != scallop) continue;
    const auto &[a, b, c] = model_.valve.triangles[t];
    const double distance2 = closest_on_triangle(p, x[a], x[b], x[c]).distance2;
    if (distance2 < nearest.distance2) nearest = {distance2, t};
  }
}

uint32_t SheetWalk::nearest(uint32_t node, const Vec3 &p, uint32_t scallop) const {
  Nearest nearest = {INFINITY, none};
  look_around(node, p, scallop, nearest);
  for (uint32_t last = none; last != nearest.triangle;) {
    last = nearest.triangle;
    for (const uint32_t corner : model_.valve.triangles[last]) {
      look_around(corner, p, scallop, nearest);
    }
  }
  return nearest.triangle;
}

}  // namespace mvs::core
