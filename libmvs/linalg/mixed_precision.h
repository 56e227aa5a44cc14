// A factor in single precision that conjugate gradients make exact.
//
// The factor takes half of the time and memory of one in double precision, and each of the few
// iterations about as long as one solution with it. Where single precision does not do, because
// rounding makes the matrix indefinite or too many iterations are needed, a factor in double
// precision is made after all. (Iterative refinement with narrow factors: Carson & Higham, SIAM J.
// Sci. Comput. 40, 2018.)
#pragma once

#include <memory>

#include "linalg/direct_solver.h"

namespace mvs::core {

std::unique_ptr<DirectSolver> make_mixed_precision_cholesky();

}  // namespace mvs::core
