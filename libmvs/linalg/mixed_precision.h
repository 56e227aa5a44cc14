// Mixed-precision Cholesky solver: a factor in single precision preconditions conjugate gradients
// in double precision.
//
// The factor takes half of the time and memory of one in double precision, and each of the few
// iterations about as long as one solution with it. If rounding makes the matrix indefinite in
// single precision, or too many iterations are needed, a factor in double precision replaces it.
// (Iterative refinement with factors of lower precision: Carson & Higham, SIAM J. Sci. Comput. 40,
// 2018.)
#pragma once

#include <memory>

#include "linalg/direct_solver.h"

namespace mvs::core {

std::unique_ptr<DirectSolver> make_mixed_precision_cholesky();

}  // namespace mvs::core
