#include "valve/at_rest.h"

#include <cstdio>

#include "text/command_units.h"
#include "text/readouts.h"

namespace cli {
namespace {

constexpr double rest_residual = 1e-5;  // N: mvs_settle_options.residual

}  // namespace

void warn_unsettled(const mvs_stats &stats, const std::string &name, const char *hint) {
  if (stats.converged) return;
  if (stats.growth_rate > 0 && stats.residual <= rest_residual) {
    std::fprintf(stderr,
                 "mvs: warning: %s is in an unstable equilibrium, to which it always returns: a "
                 "disturbance grows by e in %.2g s of overdamped motion, as where the free edge "
                 "flutters; change the chordae or the pressure\n",
                 name.c_str(), 1 / stats.growth_rate);
    return;
  }
  std::fprintf(
      stderr,
      "mvs: warning: %s is not at rest after %u iterations, residual %.1e N: its shape is not "
      "an equilibrium%s\n",
      name.c_str(), stats.iterations, stats.residual, hint);
}

void warn_crossing(const mvs_measures &measures, const std::string &name) {
  if (measures.intersections == 0) return;
  std::fprintf(
      stderr,
      "mvs: warning: the leaflets of %s cross (%u pairs of triangles): its measures do not "
      "count; the solver explicit does not prevent crossing, newton and implicit do\n",
      name.c_str(), measures.intersections);
}

AtRest settle(mvs::Simulator &sim, double pressure_mmhg, const std::string &name) {
  with_command_units([&] { sim.set_load(pressure_mmhg * pa_per_mmhg); });
  const mvs_stats stats = sim.settle();
  warn_unsettled(stats, name);
  mvs::Snapshot valve = sim.snapshot();
  const mvs_measures measures = valve.measure();
  warn_crossing(measures, name);
  return {std::move(valve), stats, measures};
}

void add_unsettled_option(CLI::App &command, bool &allowed) {
  command.add_flag("--allow-unsettled", allowed,
                   "exit code 0 also if the valve does not come to rest");
}

void demand_rest(Console &console, const mvs_stats &stats, bool allowed) {
  if (stats.converged == 0 && !allowed) console.exit_code = 1;
}

Json closure_json(const mvs::Snapshot &valve, const mvs_stats &stats,
                  const mvs_measures &measures) {
  return {{"converged", stats.converged != 0},
          {"iterations", stats.iterations},
          {"residual_N", stats.residual},
          {"stable", stats.stable != 0},
          {"stiffness_margin_N_per_m", stats.stiffness_margin},
          {"growth_rate_per_s", stats.growth_rate},
          {"energy_J", stats.energy},
          {"wall_s", stats.wall_s},
          {"intersections", measures.intersections},
          {"hash", hash_of(valve)},
          {"measures", measures_json(measures)}};
}

Json at_rest_json(const AtRest &at_rest) {
  return closure_json(at_rest.valve, at_rest.stats, at_rest.measures);
}

}  // namespace cli
