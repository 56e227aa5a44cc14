// Searches of a fit with Jacobians that are given: one on which nothing depends, and ones that
// diverge.
#include <doctest/doctest.h>

#include "base/error.h"
#include "patient/fit/fit_to_closed.h"
#include "tests/about.h"
#include "tests/patient/patient_valve.h"

using namespace mvs::core;
using namespace mvs::core::test;

namespace {

ClosedSurface closed_surface_of(const Valve &valve) {
  Solver solver(Backend::fastest);
  return {close_open(solver, make_model(valve), systolic_pressure).state.x, valve.triangles};
}

// The Jacobian of a valve whose shape does not depend on the lengths.
std::vector<std::vector<double>> flat(const std::vector<ChordGroup> &groups,
                                      const std::vector<SurfaceMatch> &matches) {
  return {groups.size(), std::vector<double>(matches.size(), 0)};
}

}  // namespace

TEST_CASE("a_jacobian_of_another_kind_can_be_given") {
  const Valve valve = patient_valve(200);
  const ClosedSurface surface = closed_surface_of(valve);
  Valve fitted = valve;
  Findings findings;
  size_t calls = 0;
  FitSettings settings;
  settings.one_by_one = false;
  settings.starts = 1;
  const ChordFit fit = fit_to_closed(fitted, surface, settings, findings,
                                     [&](const ClosedValve &, const std::vector<ChordGroup> &groups,
                                         const std::vector<SurfaceMatch> &matches) {
                                       ++calls;
                                       return flat(groups, matches);
                                     });
  // nothing depends on the lengths, so that they keep their prior
  CHECK(calls == 1);
  for (size_t k = 0; k < fit.groups.size(); ++k) {
    CHECK(fit.factor[k] == 1);
    CHECK(fit.deviation[k] == about(0.1));
  }
  CHECK(fitted.chords == valve.chords);
  CHECK(findings[1].sentence.find("does not determine") != std::string::npos);
  CHECK(findings[1].sentence.find("A strut") != std::string::npos);
}

TEST_CASE("a_search_that_diverges_is_left_out") {
  const Valve valve = patient_valve(200);
  const ClosedSurface surface = closed_surface_of(valve);
  FitSettings settings;
  settings.one_by_one = false;
  settings.starts = 2;
  // the first search takes one Jacobian
  size_t calls = 0, last = 1;
  const ClosedJacobian jacobian = [&](const ClosedValve &, const std::vector<ChordGroup> &groups,
                                      const std::vector<SurfaceMatch> &matches) {
    MVS_MUST(++calls <= last, MVS_E_DIVERGED, "settle", "it diverges");
    return std::vector<std::vector<double>>(groups.size(), std::vector<double>(matches.size(), 0));
  };
  Valve fitted = valve;
  Findings findings;
  const ChordFit fit = fit_to_closed(fitted, surface, settings, findings, jacobian);
  CHECK(calls == 2);
  CHECK(fit.at_rest);
  CHECK(fit.other_leaks.empty());
  CHECK(fitted.chords == valve.chords);
  last = 0;
  CHECK_THROWS_WITH_AS(fit_to_closed(fitted, surface, settings, findings, jacobian),
                       doctest::Contains("every length of its chordae"), Error);
}
