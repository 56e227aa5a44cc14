// Fits of fine valves that are sought on a coarser mesh.
#include "patient/fit/fit_over_levels.h"

#include <doctest/doctest.h>

#include "tests/about.h"
#include "tests/patient/patient_valve.h"

using namespace mvs::core;
using namespace mvs::core::test;

namespace {

constexpr double mm = 1e-3;

// Anterior chordae shorter, posterior marginal ones longer.
std::vector<double> changed_factors(const std::vector<ChordGroup> &groups) {
  std::vector<double> factor;
  factor.reserve(groups.size());
  for (const ChordGroup &group : groups)
    factor.push_back(group.name[0] == 'A' ? 0.93 : group.name == "P marginal" ? 1.06 : 1);
  return factor;
}

}  // namespace

TEST_CASE("lengths_of_a_fine_valve_are_sought_on_a_coarser_mesh") {
  const Valve valve = patient_valve(430);
  const std::vector<ChordGroup> groups = chord_groups(*make_model(valve), ChordGrouping::kinds);
  Valve truth = valve;
  scale_groups(truth, groups, changed_factors(groups));
  Solver solver(Backend::fastest);
  const ClosedValve target = close_open(solver, make_model(truth), systolic_pressure);
  const ClosedSurface surface{target.state.x, valve.triangles};
  FitSettings settings;
  settings.grouping = ChordGrouping::kinds;
  settings.one_by_one = false;
  settings.starts = 1;
  Valve fitted = valve;
  Findings findings;
  const ChordFit fit = fit_over_levels(fitted, surface, settings, findings, {}, 270);
  CHECK(fit.at_rest);
  CHECK(fit.rms_before > 1 * mm);
  // a mesh of 270 vertices closes to a shape of its own, from which the fine one starts
  CHECK(fit.rms < 0.5 * mm);
  REQUIRE(fit.chord_factor.size() == valve.chords.size());
  for (size_t c = 0; c < valve.chords.size(); ++c)
    CHECK(fitted.chords[c].rest_length == valve.chords[c].rest_length * fit.chord_factor[c]);
  // the finding is of the fine valve
  REQUIRE(findings.size() == 4);
  CHECK(findings[0].value[0] == fit.rms);
  const ClosedValve closed = close_open(solver, make_model(fitted), systolic_pressure);
  const SurfaceMatcher matcher(surface, *closed.model, closed.state.x);
  CHECK(rms_distance(matcher.match(*closed.model, closed.state.x)) == about(fit.rms, 0.02));
}

TEST_CASE("valves_that_are_hardly_finer_are_fitted_as_they_are") {
  const Valve valve = patient_valve(200);
  Solver solver(Backend::fastest);
  const ClosedValve closed = close_open(solver, make_model(valve), systolic_pressure);
  const ClosedSurface surface{closed.state.x, valve.triangles};
  FitSettings settings;
  settings.one_by_one = false;
  settings.starts = 1;
  settings.rounds = 1;
  Findings as_they_are, over_levels;
  Valve a = valve, b = valve;
  fit_to_closed(a, surface, settings, as_they_are);
  fit_over_levels(b, surface, settings, over_levels);
  CHECK(a.chords == b.chords);
  CHECK(as_they_are.size() == over_levels.size());
}
