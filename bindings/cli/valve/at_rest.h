// Closes a valve to rest and measures it, for commands that compare closures.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "text/console.h"

namespace cli {

struct AtRest {
  mvs::Snapshot valve;
  mvs_stats stats;
  mvs_measures measures;
};

// Unless the valve is at rest, a warning with `name` on stderr: how it ended, and a hint for one
// that is in no equilibrium.
void warn_unsettled(const mvs_stats &stats, const std::string &name, const char *hint = "");

// A warning on stderr if leaflets cross.
void warn_crossing(const mvs_measures &measures, const std::string &name);

// Settles under a pressure and measures. A valve that is not at rest is a result, not an error: it
// is warned of.
AtRest settle(mvs::Simulator &sim, double pressure_mmhg, const std::string &name);

// Adds --allow-unsettled, which has a command that closes valves end with 0 all the same.
void add_unsettled_option(CLI::App &command, bool &allowed);

// Sets the exit code to 1 if the valve is not at rest, unless that is allowed. What there is was
// written, marked as not at rest.
void demand_rest(Console &console, const mvs_stats &stats, bool allowed);

// Convergence, energy, time, intersections, hash and measures of a closure.
Json closure_json(const mvs::Snapshot &valve, const mvs_stats &stats, const mvs_measures &measures);
Json at_rest_json(const AtRest &at_rest);

}  // namespace cli
