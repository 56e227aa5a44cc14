// A valve brought to rest by a command, with all that is told of it.
#pragma once

#include <string>

#include "console.h"

namespace cli {

struct AtRest {
  mvs::Snapshot valve;
  mvs_stats stats;
  mvs_measures measures;
};

// Settles under a pressure and measures. Not at rest is a result, not a failure: it is said aloud,
// with `which` for the valve's name.
AtRest settle(mvs::Sim &sim, double pressure_mmhg, const std::string &which);

Json at_rest_json(const AtRest &at_rest);

}  // namespace cli
