// Statistics of an ensemble: mean, range, sample deviation and count of every field of mvs_measures
// over its members.
#pragma once

#include <mvs/snapshot.h>

#include <array>
#include <vector>

namespace mvs::core {

// Mean, least, most, deviation and count: in the order of mvs_ensemble_statistic.
using Statistics = std::array<mvs_measures, 5>;

Statistics statistics_of(const std::vector<const mvs_measures *> &valves);

}  // namespace mvs::core
