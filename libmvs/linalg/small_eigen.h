// Extreme eigenvalues of small matrices, by bisection and by the QR algorithm (Golub & Van Loan,
// Matrix Computations, 2013, sections 7.4, 7.5 and 8.4), with the same bits on every machine.
// Eigen's own decompositions sum in an order that depends on the processor.
#pragma once

#include <cstddef>
#include <vector>

namespace mvs::core {

// A dense matrix of n x n numbers, by rows.
struct SmallMatrix {
  explicit SmallMatrix(size_t size) : n(size), value(size * size, 0.0) {}
  double &operator()(size_t r, size_t c) { return value[r * n + c]; }
  double operator()(size_t r, size_t c) const { return value[r * n + c]; }

  size_t n;
  std::vector<double> value;
};

// The smallest eigenvalue, with its unit eigenvector, of the symmetric tridiagonal matrix with this
// diagonal and these numbers beside it (one fewer).
struct SmallestEigen {
  double value;
  std::vector<double> vector;
};
SmallestEigen smallest_eigen(const std::vector<double> &diagonal,
                             const std::vector<double> &beside);

// The eigenvalue with the smallest real part of a real matrix, of a conjugate pair the one with a
// positive imaginary part, and its eigenvector of unit length.
struct LeftmostEigen {
  double real = 0, imaginary = 0;
  std::vector<double> vector_real, vector_imaginary;
};
LeftmostEigen leftmost_eigen(const SmallMatrix &matrix);

}  // namespace mvs::core
