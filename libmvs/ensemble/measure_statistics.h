// Statistics of an ensemble: mean, range, sample deviation and count of every field of mvs_measures
// over its members.
#pragma once

#include <mvs/snapshot.h>

#include <array>
#include <vector>

namespace mvs::core {

// In the order MVS_ENSEMBLE_STATISTIC_MEAN ... MVS_ENSEMBLE_STATISTIC_COUNT.
using Statistics = std::array<mvs_measures, 5>;

Statistics statistics_of(const std::vector<const mvs_measures *> &valves);

}  // namespace mvs::core
