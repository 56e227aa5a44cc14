// Fits of rest lengths to a closed surface with each Jacobian, side by side: by linearisation with
// the damped tangent of a settle, by the exact derivatives of the room `sensitivity`, without and
// with differences where their test fails, and by differences of closures alone.
//
//   bench_fit_jacobian                          six truths of a valve of 425 vertices
//   bench_fit_jacobian --vertices 1700 --truths 2 --jacobian damped exact
//
// Truths have lengths of groups between 0.9 and 1.1 times as long, and of each chord another 0.97
// to 1.03; truths that do not come to rest are left out. CPU seconds of the whole fit; the distance
// is RMS between the fitted valve, closed from open, and the truth; rounds are of all searches.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <map>
#include <string>
#include <vector>

#include "anatomy/parametric.h"
#include "measure/orifice/orifice.h"
#include "patient/fit/fit_to_closed.h"
#include "patient/fit/linear_closure.h"
#include "patient/normal_numbers.h"
#include "tests/bench/clock.h"
#include "tests/bench/fit/exact_jacobian.h"
#include "tests/bench/table.h"

using namespace mvs::core;

namespace {

struct Options {
  uint32_t vertices = 425, truths = 6, starts = 1;
  std::vector<std::string> jacobians = {"damped", "exact", "tested", "differences"};
  std::string csv;
};

struct Truth {
  ClosedSurface surface;
  double leak = 0;
  bool at_rest = false;
};

Truth truth_of(const Valve &valve, uint64_t seed) {
  NormalNumbers random(seed);
  const auto deviate = [&](double half) { return 1 + half * (2 * random.uniform() - 1); };
  Valve changed = valve;
  for (const ChordGroup &group : chord_groups(*make_model(valve), ChordGrouping::halves)) {
    const double shared = deviate(0.1);
    for (const uint32_t c : group.chords) changed.chords[c].rest_length *= shared * deviate(0.03);
  }
  Solver solver(Backend::fastest);
  const ClosedValve closed = close_open(solver, make_model(changed), systolic_pressure);
  return {{closed.state.x, valve.triangles},
          measure_orifice(*closed.model, closed.state.x).area,
          closed.stats.converged};
}

ClosedJacobian jacobian_named(const std::string &name, Solver &solver) {
  if (name == "damped") return jacobian_by_linearisation();
  if (name == "exact") return bench::exact_jacobian(solver, false);
  if (name == "tested") return bench::exact_jacobian(solver, true);
  return jacobian_by_differences(solver);
}

int run(int argc, char **argv) {
  Options options;
  CLI::App app("Compares fits of rest lengths by their Jacobian.", "bench_fit_jacobian");
  app.add_option("--vertices", options.vertices, "of the valve")->capture_default_str();
  app.add_option("--truths", options.truths, "valves to find")->capture_default_str();
  app.add_option("--starts", options.starts, "searches of each fit")->capture_default_str();
  app.add_option("--jacobian", options.jacobians, "which")
      ->check(CLI::IsMember({"damped", "exact", "tested", "differences"}));
  app.add_option("--csv", options.csv, "file to write the table to");
  CLI11_PARSE(app, argc, argv);
  mvs_parametric_desc desc = {};
  desc.struct_size = sizeof desc;
  desc.vertices = options.vertices;
  const Valve valve = make_parametric_valve(desc);
  bench::Table table({"truth", "Jacobian   ", "chordae", "CPU s ", "rounds", "before mm", "RMS mm",
                      "leak mm2", "true mm2"},
                     options.csv);
  std::map<std::string, double> cpu, rms;
  uint32_t count = 0;
  for (uint32_t k = 0; k < options.truths; ++k) {
    const Truth truth = truth_of(valve, 1 + k);
    if (!truth.at_rest) continue;
    ++count;
    for (const std::string &name : options.jacobians) {
      Valve fitted = valve;
      Solver solver(Backend::fastest);
      FitSettings settings;
      settings.starts = options.starts;
      Findings findings;
      const double since = bench::cpu_now();
      const ChordFit fit =
          fit_to_closed(fitted, truth.surface, settings, findings, jacobian_named(name, solver));
      const double spent = bench::cpu_now() - since;
      cpu[name] += spent;
      rms[name] += fit.rms;
      table.row({k + 1, name, valve.chords.size(), spent, fit.rounds, 1e3 * fit.rms_before,
                 1e3 * fit.rms, 1e6 * fit.leak, 1e6 * truth.leak});
    }
  }
  for (const std::string &name : options.jacobians) {
    std::printf("%s: mean %.2f s, %.3f mm\n", name.c_str(), cpu[name] / std::max(count, 1u),
                1e3 * rms[name] / std::max(count, 1u));
  }
  return 0;
}

}  // namespace

int main(int argc, char **argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception &error) {
    std::fprintf(stderr, "bench_fit_jacobian: %s\n", error.what());
    return 1;
  }
}
