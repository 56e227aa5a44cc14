#include "tests/dense.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>

namespace mvs::core::test {

Dense product(const DenseView &a, const DenseView &b) {
  return a * b;
}

Eigen::VectorXd apply(const DenseView &a, const VectorView &x) {
  return a * x;
}

SymmetricEigen symmetric_eigen(const DenseView &a) {
  const Eigen::SelfAdjointEigenSolver<Dense> eigen(a);
  return {eigen.eigenvalues(), eigen.eigenvectors()};
}

Eigen::VectorXd symmetric_eigenvalues(const DenseView &a) {
  return Eigen::SelfAdjointEigenSolver<Dense>(a, Eigen::EigenvaluesOnly).eigenvalues();
}

Eigen::VectorXcd eigenvalues(const DenseView &a) {
  return Eigen::EigenSolver<Dense>(a, false).eigenvalues();
}

Dense inverse(const DenseView &a) {
  return a.inverse();
}

Eigen::VectorXd symmetric_solution(const DenseView &a, const VectorView &b) {
  return Eigen::LDLT<Dense>(a).solve(b);
}

Dense orthonormal(const DenseView &a) {
  return Eigen::HouseholderQR<Dense>(a).householderQ();
}

}  // namespace mvs::core::test
