// Clusters of vertices or faces as trees of parents: one that is its own parent is the root of a
// cluster.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

namespace mvs::core {

// Returns the root of the cluster of i, and shortens its path (path halving).
inline uint32_t root_of(std::vector<uint32_t> &parent, uint32_t i) {
  while (parent[i] != i) {
    parent[i] = parent[parent[i]];
    i = parent[i];
  }
  return i;
}

// Joins the clusters of i and j; the smaller root stays one. Returns whether they were apart.
inline bool join(std::vector<uint32_t> &parent, uint32_t i, uint32_t j) {
  const uint32_t a = root_of(parent, i), b = root_of(parent, j);
  parent[std::max(a, b)] = std::min(a, b);
  return a != b;
}

}  // namespace mvs::core
