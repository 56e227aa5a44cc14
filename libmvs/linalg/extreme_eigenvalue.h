// Extreme eigenvalues of a large sparse matrix, by a factor of a matrix near it: Lanczos' method on
// the inverse for the smallest eigenvalue of a symmetric matrix, and Davidson's method for the
// leftmost one of an unsymmetric matrix (Saad, Numerical Methods for Large Eigenvalue Problems,
// 2011, sections 6.6 and 8.4; Morgan & Scott, SIAM J. Sci. Stat. Comput. 7, 1986).
#pragma once

#include <functional>
#include <vector>

#include "base/types.h"

namespace mvs::core {

using BlockVector = std::vector<Vec3>;
// Sets y to a matrix, or its inverse, times v.
using LinearMap = std::function<void(const BlockVector &v, BlockVector &y)>;

struct Eigenpair {
  double real = 0, imaginary = 0;
  BlockVector vector;  // its real part
  double error =
      0;  // norm of the residual over that of the eigenvalue, or over the scale asked for
  uint32_t iterations = 0;
};

struct EigenGoal {
  double error;      // Eigenpair::error
  uint32_t most;     // iterations
  double scale = 0;  // eigenvalues smaller than this need no relative accuracy
};

// The smallest eigenvalue of a symmetric positive definite matrix, given by its inverse, and a unit
// eigenvector. `start` is any vector; parts of the matrix where it is zero, and that are not
// coupled with others, are left out. Adds the orthonormal vectors that it computes to `basis`.
Eigenpair smallest_eigenvalue(const LinearMap &solve, const BlockVector &start,
                              const EigenGoal &goal, std::vector<BlockVector> &basis);

// The eigenvalue of K v = kappa B v with the smallest real part, B a positive diagonal matrix with
// one number a row. `solve` approximates the inverse of K, and `basis` spans the space to begin
// with; it is used up.
Eigenpair leftmost_eigenvalue(const LinearMap &multiply, const LinearMap &solve,
                              const std::vector<double> &weight, std::vector<BlockVector> basis,
                              const EigenGoal &goal);

}  // namespace mvs::core
