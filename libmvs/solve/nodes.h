// What every solver asks about nodes that are free to move, and about those that are prescribed.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

#include "model/model.h"

namespace mvs::core {

// m2, of the sheet for each node.
inline double mean_area(const Model &model) {
  double area = 0;
  for (const double a : model.rest_area) area += a;
  return area / static_cast<double>(model.node_count());
}

// Pa; an unloaded valve is scaled as if by 1 kPa, the pressure of a relaxed ventricle.
inline double scale_of(const Load &load) {
  return std::max(std::abs(load.pressure), 1e3);
}

// The longest of the vectors on free nodes: of forces, the residual.
inline double largest_free(const Model &model, const std::vector<Vec3> &g) {
  double square = 0;
  for (size_t i = 0; i < g.size(); ++i) {
    if (!model.topology.fixed[i]) square = std::max(square, g[i].squaredNorm());
  }
  return std::sqrt(square);
}

// Whether every prescribed node has come within a distance of its target; 0: to the bit.
inline bool boundary_is_there(const Model &model, const std::vector<Vec3> &x, double fraction,
                              double within) {
  for (uint32_t i = 0; i < x.size(); ++i) {
    if (!model.topology.fixed[i]) continue;
    if (!((model.target(i, fraction) - x[i]).squaredNorm() <= within * within)) return false;
  }
  return true;
}

// To the bit: -0.0 is not 0.0.
inline bool same_bits(const std::vector<Vec3> &a, const std::vector<Vec3> &b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(Vec3)) == 0;
}

}  // namespace mvs::core
