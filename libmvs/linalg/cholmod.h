// The CHOLMOD backend, and the expansion of blocks to scalar columns that both scalar backends use.
#pragma once

#include <mvs/sim.h>

#include <memory>

#include "linalg/direct_solver.h"

namespace mvs::core {

std::unique_ptr<DirectSolver> make_cholmod_solver();

// Writes the lower triangle as scalar columns: 3 n + 1 starts, 9 * blocks - 3 n rows and values.
void expand_lower(const BlockMatrix &matrix, int *start, int *row, double *value);

}  // namespace mvs::core
