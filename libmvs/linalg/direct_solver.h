// Sparse Cholesky factors of a BlockMatrix, behind one interface: our own, CHOLMOD, Eigen.
#pragma once

#include <memory>
#include <vector>

#include "linalg/block_matrix.h"

namespace mvs::core {

class DirectSolver {
 public:
  virtual ~DirectSolver() = default;
  // Takes the pattern in; call it again when the pattern changes. The rows are expected in a
  // fill-reducing order already (see fill_reducing_order).
  virtual void analyse(const BlockMatrix &matrix) = 0;
  // Factorises the values; false if the matrix is not positive definite (or not finite).
  virtual bool factorise(const BlockMatrix &matrix) = 0;
  // The same in parts of about equal work, 0 to parts - 1, of the same values: the bits are those
  // of factorise(). A backend that cannot be interrupted does all of it in the last one.
  virtual bool factorise_part(const BlockMatrix &matrix, uint32_t part, uint32_t parts) {
    return part + 1 < parts || factorise(matrix);
  }
  // Solves in place with the last factor.
  virtual void solve(std::vector<Vec3> &b) = 0;
  // Iterations of the last solution, of a factor that needs some.
  virtual uint32_t iterations() const { return 0; }
};

// A factorisation of the named MVS_BACKEND_*; throws MVS_E_UNSUPPORTED if this build lacks it.
std::unique_ptr<DirectSolver> make_direct_solver(uint32_t backend);

// The backends of this build by name, separated by spaces.
const char *factor_names();

// An elimination order for rows 0 .. n that keeps the factor sparse (approximate minimum degree):
// order[k] is the row eliminated k-th.
std::vector<uint32_t> fill_reducing_order(uint32_t n, const std::vector<Edge> &pairs);

}  // namespace mvs::core
