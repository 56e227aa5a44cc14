// Sparse direct solvers of a BlockMatrix behind one interface: the library's own, CHOLMOD, Eigen.
#pragma once

#include <mvs/sim.h>

#include <memory>
#include <vector>

#include "base/workers.h"
#include "linalg/block_matrix.h"

namespace mvs::core {

// The numbers are those of the C interface. `fastest`: in solve the block Cholesky in single
// precision as a preconditioner, elsewhere `block`.
enum class Backend : uint32_t {
  fastest = MVS_BACKEND_DEFAULT,
  cholmod = MVS_BACKEND_CHOLMOD,
  eigen = MVS_BACKEND_EIGEN,
  block = MVS_BACKEND_BLOCK
};

class DirectSolver {
 public:
  virtual ~DirectSolver() = default;
  // Symbolic factorisation; to be called again when the pattern changes. The rows have to be in a
  // fill-reducing order already (see fill_reducing_order).
  virtual void analyse(const BlockMatrix &matrix) = 0;
  // Factorises the values; false if the matrix is not positive definite (or not finite).
  virtual bool factorise(const BlockMatrix &matrix) = 0;
  // The same with the cheap one of two factors alone, where a backend has two: false as well if
  // rounding makes it fail.
  virtual bool factorise_cheaply(const BlockMatrix &matrix) { return factorise(matrix); }
  // The same in parts of about equal work, 0 to parts - 1, of the same values, with the bits of
  // factorise(). A backend that cannot be interrupted does all work in the last part.
  virtual bool factorise_part(const BlockMatrix &matrix, uint32_t part, uint32_t parts) {
    return part + 1 < parts || factorise(matrix);
  }
  // Solves in place with the last factor.
  virtual void solve(std::vector<Vec3> &b) = 0;
  // Applies the factor once, as a preconditioner: without the iterations of a solution.
  virtual void precondition(std::vector<Vec3> &b) { solve(b); }
  // Makes the factor as accurate as the backend can; false if it is already, or cannot be.
  virtual bool sharpen() { return false; }
  // Products of blocks in a factorisation of the analysed pattern, about; 0 if it is unknown.
  virtual double products() const { return 0; }
  // Iterations of the last solution; 0 for a direct one.
  virtual uint32_t iterations() const { return 0; }

  // Threads that may share the work; they outlive the solver. Null, the default: none. The bits do
  // not depend on them.
  virtual void use_workers(Workers *workers) { workers_ = workers; }
  Workers *workers() const { return workers_; }

 private:
  Workers *workers_ = nullptr;
};

// Makes the solver of a backend; throws MVS_E_UNSUPPORTED if this build lacks it.
std::unique_ptr<DirectSolver> make_direct_solver(Backend backend);

// Returns the names of the backends of this build, separated by spaces.
const char *factor_names();

// Returns an elimination order of n rows that keeps the factor sparse (approximate minimum degree):
// order[k] is the row eliminated k-th.
std::vector<uint32_t> fill_reducing_order(uint32_t n, const std::vector<Edge> &pairs);

}  // namespace mvs::core
