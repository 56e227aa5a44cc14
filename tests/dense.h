// Dense algebra that results are compared with. Its decompositions and products are compiled once,
// in dense.cpp: each file that instantiated Eigen's own would take 5 to 15 s longer to compile.
#pragma once

#include <Eigen/Core>

namespace mvs::core::test {

using Dense = Eigen::MatrixXd;
using DenseView = Eigen::Ref<const Dense>;
using VectorView = Eigen::Ref<const Eigen::VectorXd>;

// Products of matrices, and of a matrix and a vector.
Dense product(const DenseView &a, const DenseView &b);
Eigen::VectorXd apply(const DenseView &a, const VectorView &x);

// The eigenvalues of a symmetric matrix, ascending, and its eigenvectors as columns.
struct SymmetricEigen {
  Eigen::VectorXd values;
  Dense vectors;
};
SymmetricEigen symmetric_eigen(const DenseView &a);
Eigen::VectorXd symmetric_eigenvalues(const DenseView &a);

// The eigenvalues of any square matrix, in no order.
Eigen::VectorXcd eigenvalues(const DenseView &a);

Dense inverse(const DenseView &a);

// The solution of a x = b with a symmetric, definite a.
Eigen::VectorXd symmetric_solution(const DenseView &a, const VectorView &b);

// Orthonormal columns that span those of a square, regular matrix.
Dense orthonormal(const DenseView &a);

}  // namespace mvs::core::test
