// Check of a state that says of itself that it is at rest, as a file that people edit may.
#pragma once

#include <string>

#include "model/model.h"

namespace mvs::core {

// Returns why a state that says that it is at rest is not, as "its largest out-of-balance force is
// 0.3 N"; "" for a state at rest, and for one that does not say so. One evaluation of the forces.
std::string fault_of_rest(const Model &model, const State &state);

}  // namespace mvs::core
