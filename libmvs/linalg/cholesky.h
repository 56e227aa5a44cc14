// The library's own backend: see factor_block.cpp.
#pragma once

#include <memory>

#include "linalg/direct_solver.h"

namespace mvs::core {

std::unique_ptr<DirectSolver> make_block_factor();

// The same in single precision, for half of the memory and of the time: a preconditioner. Its
// factorisation fails where rounding alone makes a matrix indefinite, so of condition 1e7 or so.
std::unique_ptr<DirectSolver> make_narrow_factor();

}  // namespace mvs::core
