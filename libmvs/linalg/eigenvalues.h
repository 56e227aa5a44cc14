// Eigenvalues of symmetric 3x3 matrices, and their projection to a range.
#pragma once

#include <Eigen/Eigenvalues>

#include "base/types.h"

namespace mvs::core {

inline double largest_eigenvalue(const Mat3 &m) {
  return Eigen::SelfAdjointEigenSolver<Mat3>(m, Eigen::EigenvaluesOnly).eigenvalues()[2];
}

// Returns the matrix with its eigenvalues clamped to a range; the same bits if they are in it.
inline Mat3 with_eigenvalues_in(const Mat3 &m, double low, double high) {
  const Eigen::SelfAdjointEigenSolver<Mat3> eigen(m);
  const Vec3 values = eigen.eigenvalues();
  if (values[0] >= low && values[2] <= high) return m;
  const Vec3 kept = values.cwiseMax(low).cwiseMin(high);
  return eigen.eigenvectors() * kept.asDiagonal() * eigen.eigenvectors().transpose();
}

}  // namespace mvs::core
