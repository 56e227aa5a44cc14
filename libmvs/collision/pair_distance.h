// Two things of a sheet that may meet: whether they have nodes in common, and how far apart they
// are. Whoever makes pairs asks here, so that all find the same bits.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/types.h"
#include "geometry/distance.h"
#include "geometry/distance_batch.h"

namespace mvs::core {

inline bool has(const Tri &t, uint32_t node) {
  return t[0] == node || t[1] == node || t[2] == node;
}

inline bool share(const Edge &a, const Edge &b) {
  return a[0] == b[0] || a[0] == b[1] || a[1] == b[0] || a[1] == b[1];
}

inline double distance_of(const std::vector<Vec3> &x, uint32_t v, const Tri &t) {
  return std::sqrt(closest_on_triangle(x[v], x[t[0]], x[t[1]], x[t[2]]).distance2);
}

// Rounded by the order of the edges.
inline double distance_of(const std::vector<Vec3> &x, const Edge &e, const Edge &f) {
  return std::sqrt(closest_of_segments(x[e[0]], x[e[1]], x[f[0]], x[f[1]]).distance2);
}

// The same pairs, to be measured many at a time.
inline void set_pair(DistanceBatch &rows, uint32_t pair, const std::vector<Vec3> &x, uint32_t v,
                     const Tri &t) {
  rows.set(pair, 0, x[v]);
  for (uint32_t k = 0; k < 3; ++k) rows.set(pair, k + 1, x[t[k]]);
}

inline void set_pair(DistanceBatch &rows, uint32_t pair, const std::vector<Vec3> &x, const Edge &e,
                     const Edge &f) {
  for (uint32_t k = 0; k < 2; ++k) {
    rows.set(pair, k, x[e[k]]);
    rows.set(pair, k + 2, x[f[k]]);
  }
}

// As many pairs at a time as rows hold: work(the first of them, their number).
template <typename Work>
void for_rows(const std::vector<Edge> &pairs, Work &&work) {
  for (size_t first = 0; first < pairs.size(); first += DistanceBatch::most) {
    const size_t count = std::min<size_t>(DistanceBatch::most, pairs.size() - first);
    work(pairs.data() + first, static_cast<uint32_t>(count));
  }
}

}  // namespace mvs::core
