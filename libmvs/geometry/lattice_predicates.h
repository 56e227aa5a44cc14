// Exact predicates of points on an integer lattice.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "geometry/delaunay3d.h"

namespace mvs::core {

__extension__ typedef __int128 Wide;
using Step = std::array<int64_t, 3>;

inline Step step(const LatticePoint &from, const LatticePoint &to) {
  return {int64_t{to[0]} - from[0], int64_t{to[1]} - from[1], int64_t{to[2]} - from[2]};
}

// Returns six times the volume, below 3 * 2^61.
inline int64_t volume(const LatticePoint &a, const LatticePoint &b, const LatticePoint &c,
                      const LatticePoint &d) {
  const Step u = step(a, b), v = step(a, c), w = step(a, d);
  return (u[0] * v[1] - u[1] * v[0]) * w[2] + (u[1] * v[2] - u[2] * v[1]) * w[0] +
         (u[2] * v[0] - u[0] * v[2]) * w[1];
}

// Whether p is strictly inside the sphere through a, b, c, d, which have positive volume: in exact
// integers.
inline bool in_sphere(const LatticePoint &a, const LatticePoint &b, const LatticePoint &c,
                      const LatticePoint &d, const LatticePoint &p) {
  const std::array<Step, 4> row = {step(p, a), step(p, b), step(p, c), step(p, d)};
  const auto minor = [&](int i, int j) { return row[i][0] * row[j][1] - row[i][1] * row[j][0]; };
  const int64_t ab = minor(0, 1), ac = minor(0, 2), ad = minor(0, 3);
  const int64_t bc = minor(1, 2), bd = minor(1, 3), cd = minor(2, 3);
  const std::array<int64_t, 4> volume = {row[1][2] * cd - row[2][2] * bd + row[3][2] * bc,
                                         row[2][2] * ad - row[0][2] * cd - row[3][2] * ac,
                                         row[0][2] * bd - row[1][2] * ad + row[3][2] * ab,
                                         row[1][2] * ac - row[0][2] * bc - row[2][2] * ab};
  Wide exact = 0;
  for (size_t i = 0; i < 4; ++i) {
    const int64_t lift = row[i][0] * row[i][0] + row[i][1] * row[i][1] + row[i][2] * row[i][2];
    exact += Wide{lift} * volume[i];
  }
  return exact > 0;
}

}  // namespace mvs::core
