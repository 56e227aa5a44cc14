// Mean, range and deviation of every figure of mvs_measures over several valves.
#pragma once

#include <mvs/snapshot.h>

#include <array>
#include <vector>

namespace mvs::core {

// As MVS_ENSEMBLE_STATISTIC_MEAN ... MVS_ENSEMBLE_STATISTIC_COUNT, in that order.
using Statistics = std::array<mvs_measures, 5>;

Statistics statistics_of(const std::vector<const mvs_measures *> &valves);

}  // namespace mvs::core
