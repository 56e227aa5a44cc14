// Small dense normal equations with bounds, in scalar loops with the same bits on every machine.
#pragma once

#include <cstddef>
#include <vector>

namespace mvs::core {

// A symmetric positive definite matrix, row by row.
struct DenseMatrix {
  size_t size = 0;
  std::vector<double> entry;

  explicit DenseMatrix(size_t n) : size(n), entry(n * n, 0) {}
  double &at(size_t i, size_t j) { return entry[i * size + j]; }
  double at(size_t i, size_t j) const { return entry[i * size + j]; }
};

// x with h x = b, by Cholesky factorisation.
std::vector<double> solve_dense(const DenseMatrix &h, const std::vector<double> &b);

// Minimises x h x / 2 - b x with low <= x <= high: variables whose bound is in the way are held
// there, one set after the other.
std::vector<double> solve_bounded(const DenseMatrix &h, const std::vector<double> &b,
                                  const std::vector<double> &low, const std::vector<double> &high);

// The diagonal of the inverse.
std::vector<double> inverse_diagonal(const DenseMatrix &h);

}  // namespace mvs::core
