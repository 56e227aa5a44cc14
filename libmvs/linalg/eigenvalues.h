// Eigenvalues of symmetric matrices of fixed size, and their projection to a range.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/types.h"

namespace mvs::core {

using Mat6 = Eigen::Matrix<double, 6, 6>;

// m = vectors * diagonal of values * transposed vectors, in no order.
template <typename Matrix>
struct JacobiEigen {
  Matrix vectors;
  double values[Matrix::RowsAtCompileTime];
};

// Cyclic Jacobi rotations (Golub and Van Loan, Matrix Computations, 4th ed., 2013, section 8.5).
// Their loops over single elements give the same bits with every vector width. With Eigen's solver
// session/device_view.cpp takes 13 s to compile, with them 5.
template <typename Matrix>
JacobiEigen<Matrix> jacobi_eigen(Matrix m) {
  constexpr int n = Matrix::RowsAtCompileTime;
  // Convergence is quadratic: six sweeps reach rounding at this size.
  constexpr int most_sweeps = 20;
  JacobiEigen<Matrix> out = {Matrix::Identity(), {}};
  bool rotated = true;
  for (int sweep = 0; sweep < most_sweeps && rotated; ++sweep) {
    rotated = false;
    for (int p = 0; p < n; ++p)
      for (int q = p + 1; q < n; ++q) {
        const double off = m(p, q);
        constexpr double eps = std::numeric_limits<double>::epsilon();
        if (std::abs(off) <= eps * std::sqrt(std::abs(m(p, p)) * std::abs(m(q, q)))) continue;
        rotated = true;
        // Tangent, cosine and sine of the smaller angle that makes the element zero.
        const double theta = (m(q, q) - m(p, p)) / (2 * off);
        const double t =
            (theta < 0 ? -1.0 : 1.0) / (std::abs(theta) + std::sqrt(theta * theta + 1));
        const double c = 1 / std::sqrt(t * t + 1), s = t * c;
        for (int k = 0; k < n; ++k) {
          const double mp = m(k, p), mq = m(k, q);
          m(k, p) = c * mp - s * mq;
          m(k, q) = s * mp + c * mq;
          const double vp = out.vectors(k, p), vq = out.vectors(k, q);
          out.vectors(k, p) = c * vp - s * vq;
          out.vectors(k, q) = s * vp + c * vq;
        }
        for (int k = 0; k < n; ++k) {
          const double mp = m(p, k), mq = m(q, k);
          m(p, k) = c * mp - s * mq;
          m(q, k) = s * mp + c * mq;
        }
      }
  }
  for (int i = 0; i < n; ++i) out.values[i] = m(i, i);
  return out;
}

inline double largest_eigenvalue(const Mat3 &m) {
  const auto eigen = jacobi_eigen(m);
  return std::max({eigen.values[0], eigen.values[1], eigen.values[2]});
}

// Returns the matrix with its eigenvalues clamped to a range; the same bits if they are in it.
template <typename Matrix>
Matrix with_eigenvalues_in(const Matrix &m, double low, double high) {
  constexpr int n = Matrix::RowsAtCompileTime;
  const JacobiEigen<Matrix> eigen = jacobi_eigen(m);
  bool inside = true;
  for (const double value : eigen.values) inside = inside && value >= low && value <= high;
  if (inside) return m;
  Matrix out;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j <= i; ++j) {
      double sum = 0;
      for (int k = 0; k < n; ++k)
        sum += eigen.vectors(i, k) * std::clamp(eigen.values[k], low, high) * eigen.vectors(j, k);
      out(i, j) = out(j, i) = sum;
    }
  return out;
}

}  // namespace mvs::core
