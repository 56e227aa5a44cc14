// Eigenvalues of symmetric matrices of fixed size, and their projection to a range.
#pragma once

#include <Eigen/Eigenvalues>

#include "base/types.h"

namespace mvs::core {

using Mat6 = Eigen::Matrix<double, 6, 6>;

inline double largest_eigenvalue(const Mat3 &m) {
  return Eigen::SelfAdjointEigenSolver<Mat3>(m, Eigen::EigenvaluesOnly).eigenvalues()[2];
}

// Returns the matrix with its eigenvalues clamped to a range; the same bits if they are in it.
template <typename Matrix>
Matrix with_eigenvalues_in(const Matrix &m, double low, double high) {
  const Eigen::SelfAdjointEigenSolver<Matrix> eigen(m);
  const auto values = eigen.eigenvalues();
  if (values[0] >= low && values[values.size() - 1] <= high) return m;
  const auto kept = values.cwiseMax(low).cwiseMin(high).eval();
  return eigen.eigenvectors() * kept.asDiagonal() * eigen.eigenvectors().transpose();
}

}  // namespace mvs::core
