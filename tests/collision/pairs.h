// Fixtures: sheets near each other, and all pairs of a sheet by brute force.
#pragma once

#include <cmath>

#include "geometry/distance.h"
#include "tests/solve/bench.h"

namespace mvs::core::test {

inline double distance(const Positions &x, uint32_t v, const Tri &t) {
  return std::sqrt(closest_on_triangle(x[v], x[t[0]], x[t[1]], x[t[2]]).distance2);
}

inline double distance(const Positions &x, const Edge &e, const Edge &f) {
  return std::sqrt(closest_of_segments(x[e[0]], x[e[1]], x[f[0]], x[f[1]]).distance2);
}

inline bool has(const Tri &t, uint32_t v) {
  return t[0] == v || t[1] == v || t[2] == v;
}

// All pairs without a common node, in the order of the broad phase.
template <typename Visit>
void for_vertex_triangles(const Model &model, Visit &&visit) {
  for (uint32_t v = 0; v < model.node_count(); ++v) {
    if (model.vertex_area[v] == 0) continue;  // heads and branch points do not belong to the sheet
    for (uint32_t t = 0; t < model.valve.triangles.size(); ++t) {
      if (!has(model.valve.triangles[t], v)) visit(v, t);
    }
  }
}
// Two plates that wave near each other and do not cross.
inline Positions wavy(const Plates &plates, Random &random) {
  Positions x = plates.at(0.5e-3);
  const double phase = random(0, 6), other = random(0, 6);
  for (Vec3 &p : x) {
    p.z() += 1e-3 * std::sin(400 * p.x() + phase) * std::cos(300 * p.y() + other);
    p += random.vector(0.08e-3);
  }
  return x;
}

inline Plates plates_for_steps() {
  return two_plates(8, 10e-3, 3e-3, false, [](Valve &) {});
}

inline Positions moved(const Positions &x, double share, const Positions &dx) {
  Positions y = x;
  for (size_t i = 0; i < y.size(); ++i) y[i] += share * dx[i];
  return y;
}

}  // namespace mvs::core::test
