// Rank-one updates of a block matrix: times * g g^T for a gradient g of four nodes, the Hessian
// contribution of an energy term with one degree of freedom.
#pragma once

#include <array>

#include "base/types.h"

namespace mvs::core {

// Three numbers for each of four nodes; the last number is padding that SIMD loads read.
struct Slope {
  std::array<double, 13> number;

  Eigen::Map<Vec3> node(uint32_t k) { return Eigen::Map<Vec3>(&number[3 * k]); }
  Eigen::Map<const Vec3> node(uint32_t k) const { return Eigen::Map<const Vec3>(&number[3 * k]); }
};

// The blocks of four nodes and of their pairs (1, 0), (2, 0), (2, 1) ...; `lower` if the row of a
// block is the first node of the pair.
struct OuterProductTarget {
  std::array<double *, 4> diagonal;
  std::array<double *, 6> pair;
  std::array<bool, 6> lower;
};

// Adds times * slope slope^T, with the same bits on every processor and in either triangle.
void add_outer_product(const Slope &slope, double times, const OuterProductTarget &to);

}  // namespace mvs::core
