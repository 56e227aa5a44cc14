// Reads loads and solver options, writes solver statistics, for every call that settles.
#pragma once

#include <mvs/profile.h>

#include "solve/solver.h"

namespace mvs::core {

// Both throw MVS_E_ARGUMENT if a value is out of its range.
Load read_load(const mvs_load_case *given);
SolveOptions read_options(const mvs_settle_options *given);

mvs_stats public_stats(const SolveStats &from);
mvs_profile public_profile(const SolveStats &from);

}  // namespace mvs::core
