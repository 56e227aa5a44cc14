// LU factor of a small dense matrix by Gaussian elimination with partial pivoting (Golub & Van
// Loan, Matrix Computations, 2013, section 3.4). The same bits on every machine: sums run in order.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

namespace mvs::core {

class DenseFactor {
 public:
  // `a` is square, of `n` rows, row-major.
  DenseFactor(size_t n, std::vector<double> a);

  // False if a pivot vanished.
  bool is_regular() const { return is_regular_; }
  // Solves in place.
  void solve(std::vector<double> &b) const;

 private:
  size_t n_;
  std::vector<double> a_;
  std::vector<size_t> pivot_;
  bool is_regular_ = true;
};

}  // namespace mvs::core
