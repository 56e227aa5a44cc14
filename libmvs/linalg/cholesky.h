// Sparse Cholesky factorisation on 3x3 blocks: the library's own backend.
#pragma once

#include <memory>

#include "linalg/direct_solver.h"

namespace mvs::core {

// A factor that also solves for right-hand sides that are zero outside of a few rows, where no
// other row of the solution is wanted: through the supernodes on the ways from these rows to the
// root of the elimination tree, with the bits of a whole solution (Davis, Direct Methods, 2006,
// section 3.2).
class RowSolver : public DirectSolver {
 public:
  // After analyse(), which forgets the rows.
  virtual void choose_rows(const std::vector<uint32_t> &rows) = 0;
  // Solves in place; b[k] is of rows[k].
  virtual void solve_rows(std::vector<Vec3> &b) = 0;
};

std::unique_ptr<DirectSolver> make_block_factor();
std::unique_ptr<RowSolver> make_row_solver();  // the same factor

// The same in single precision, for half of the memory and of the time: a preconditioner. Its
// factorisation fails if rounding alone makes a matrix indefinite, from a condition of about 1e7.
std::unique_ptr<DirectSolver> make_float_factor();

// The same, solving with its numbers in 16 bits: for factors larger than the caches, on one thread.
std::unique_ptr<DirectSolver> make_compact_factor();

}  // namespace mvs::core
