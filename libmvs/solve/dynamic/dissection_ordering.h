// Elimination order of a step matrix by geometric nested dissection at the positions where it was
// assembled (linalg/nested_dissection.h), so that sheets in contact are on one side of a separator.
// For large sheets: it allocates memory.
#pragma once

#include <vector>

#include "solve/dynamic/step_matrix.h"

namespace mvs::core {

// Returns the free nodes in the order of their elimination, for the blocks of the matrix that are
// not zero: entries that a pattern keeps of earlier contact must not change the factor.
std::vector<uint32_t> dissection_order(const StepMatrix &matrix, const std::vector<Vec3> &x);

}  // namespace mvs::core
