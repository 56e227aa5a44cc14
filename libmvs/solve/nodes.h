// Small functions over all nodes that the solvers share.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

#include "model/model.h"

namespace mvs::core {

// Mean area of the sheet per node, m2.
inline double mean_area(const Model &model) {
  double area = 0;
  for (const double a : model.rest_area) area += a;
  return area / static_cast<double>(model.node_count());
}

// The pressure that forces are measured by, Pa: at least 1 kPa, that of a relaxed ventricle.
inline double scale_of(const Load &load) {
  return std::max(std::abs(load.pressure), 1e3);
}

// The length of the longest vector on a free node. For g = dE/dx it is the residual.
inline double largest_free(const Model &model, const std::vector<Vec3> &g) {
  double square = 0;
  for (size_t i = 0; i < g.size(); ++i) {
    if (!model.topology.fixed[i]) square = std::max(square, g[i].squaredNorm());
  }
  return std::sqrt(square);
}

// Equality bit for bit: -0.0 differs from 0.0.
inline bool same_bits(const std::vector<Vec3> &a, const std::vector<Vec3> &b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(Vec3)) == 0;
}

}  // namespace mvs::core
