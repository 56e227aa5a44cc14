// Products of a slope with itself, added to blocks of a matrix: what a term with one degree of
// freedom gives to a Hessian.
#pragma once

#include <array>

#include "base/types.h"

namespace mvs::core {

// Of four nodes, one after the other; the last number is read past them, and not used.
struct Slope {
  std::array<double, 13> number;

  Eigen::Map<Vec3> node(uint32_t k) { return Eigen::Map<Vec3>(&number[3 * k]); }
  Eigen::Map<const Vec3> node(uint32_t k) const { return Eigen::Map<const Vec3>(&number[3 * k]); }
};

// The blocks of four nodes and of their pairs (1, 0), (2, 0), (2, 1) ...; whether the row of a
// block is the first of the pair.
struct OuterProductTarget {
  std::array<double *, 4> diagonal;
  std::array<double *, 6> pair;
  std::array<bool, 6> lower;
};

// Adds times * slope slope^T. The bits are the same on every processor, and in either triangle.
void add_outer_product(const Slope &slope, double times, const OuterProductTarget &to);

}  // namespace mvs::core
