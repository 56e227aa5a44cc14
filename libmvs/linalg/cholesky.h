// Sparse Cholesky factorisation on 3x3 blocks: the library's own backend.
#pragma once

#include <memory>

#include "linalg/direct_solver.h"

namespace mvs::core {

std::unique_ptr<DirectSolver> make_block_factor();

// The same in single precision, for half of the memory and of the time: a preconditioner. Its
// factorisation fails if rounding alone makes a matrix indefinite, from a condition of about 1e7.
std::unique_ptr<DirectSolver> make_float_factor();

// The same, solving with its numbers in 16 bits: for factors larger than the caches, on one thread.
std::unique_ptr<DirectSolver> make_compact_factor();

}  // namespace mvs::core
