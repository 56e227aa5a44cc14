#include "valve/at_rest.h"

#include <cstdio>

#include "text/readouts.h"

namespace cli {

AtRest settle(mvs::Sim &sim, double pressure_mmhg, const std::string &name) {
  sim.set_load(pressure_mmhg * pa_per_mmhg);
  const mvs_stats stats = sim.settle();
  if (!stats.converged) {
    std::fprintf(stderr, "mvs: warning: %s is not at rest after %u iterations, residual %.1e N\n",
                 name.c_str(), stats.iterations, stats.residual);
  }
  mvs::Snapshot valve = sim.snapshot();
  const mvs_measures measures = valve.measure();
  return {std::move(valve), stats, measures};
}

Json at_rest_json(const AtRest &at_rest) {
  return {{"converged", at_rest.stats.converged != 0},
          {"iterations", at_rest.stats.iterations},
          {"residual_N", at_rest.stats.residual},
          {"wall_s", at_rest.stats.wall_s},
          {"intersections", at_rest.measures.intersections},
          {"hash", hash_of(at_rest.valve)},
          {"measures", measures_json(at_rest.measures)}};
}

}  // namespace cli
