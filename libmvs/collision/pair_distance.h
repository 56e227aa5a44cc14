// Distance of a vertex and a triangle, or of two edges, of one surface, alone and in batches with
// the same bits. Every list of pairs is made with these functions.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/types.h"
#include "geometry/distance.h"
#include "geometry/distance_batch.h"

namespace mvs::core {

inline double distance_of(const std::vector<Vec3> &x, uint32_t v, const Tri &t) {
  return std::sqrt(closest_on_triangle(x[v], x[t[0]], x[t[1]], x[t[2]]).distance2);
}

// The rounding depends on the order of the edges.
inline double distance_of(const std::vector<Vec3> &x, const Edge &e, const Edge &f) {
  return std::sqrt(closest_of_segments(x[e[0]], x[e[1]], x[f[0]], x[f[1]]).distance2);
}

// The same pairs as an entry of a batch.
inline void set_pair(DistanceBatch &batch, uint32_t pair, const std::vector<Vec3> &x, uint32_t v,
                     const Tri &t) {
  batch.set(pair, 0, x[v]);
  for (uint32_t k = 0; k < 3; ++k) batch.set(pair, k + 1, x[t[k]]);
}

inline void set_pair(DistanceBatch &batch, uint32_t pair, const std::vector<Vec3> &x, const Edge &e,
                     const Edge &f) {
  for (uint32_t k = 0; k < 2; ++k) {
    batch.set(pair, k, x[e[k]]);
    batch.set(pair, k + 2, x[f[k]]);
  }
}

// Calls work(first pair, count) for as many pairs at a time as a batch holds.
template <typename Work>
void for_batches(const std::vector<Edge> &pairs, Work &&work) {
  for (size_t first = 0; first < pairs.size(); first += DistanceBatch::most) {
    const size_t count = std::min<size_t>(DistanceBatch::most, pairs.size() - first);
    work(pairs.data() + first, static_cast<uint32_t>(count));
  }
}

}  // namespace mvs::core
