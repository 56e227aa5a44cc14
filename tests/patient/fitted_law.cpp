// The tissue law by a closed surface: the choice among fits, and fits of valves of known tissue.
#include "patient/fit/fitted_law.h"

#include <doctest/doctest.h>

#include "patient/findings.h"
#include "patient/fit/closure.h"
#include "tests/about.h"
#include "tests/patient/patient_valve.h"
#include "tests/short_run.h"

using namespace mvs::core;
using namespace mvs::core::test;

namespace {

constexpr double mm = 1e-3;

LawFit fit_of(LeafletLawId law, double distance, double edge = 0) {
  LawFit fit;
  fit.law = law;
  fit.distance = distance;
  fit.edge = edge;
  return fit;
}

Valve with_chordae(const PatientGeometry &g, LeafletLawId law) {
  Findings findings;
  Valve valve = leaflets_of(g, law);
  add_chordae(valve, g, find_papillary_tips({}, g, findings), {}, findings);
  return valve;
}

}  // namespace

TEST_CASE("law_of_the_nearest_fit_comes_first_and_is_surer_if_it_is_a_tenth_nearer") {
  using enum LeafletLawId;
  for (const double near : {0.899, 0.901}) {
    const std::vector<LawFit> fits = in_order(
        {fit_of(bilinear, 1 * mm), fit_of(may_newman_yin, 1.2 * mm), fit_of(prot, near * mm)});
    CHECK(fits[0].law == prot);
    CHECK(fits[2].law == may_newman_yin);
    const Finding tissue = tissue_found(fits, prot);
    CHECK(tissue.name == "tissue");
    CHECK(tissue.source == FindingSource::guessed);
    CHECK(tissue.value == std::vector<double>{static_cast<double>(prot)});
    CHECK(tissue.confidence == (near < 0.9 ? 0.6 : 0.4));
    // one that is taken as the fine valve of the nearest failed is not sure
    CHECK(tissue_found(fits, bilinear).confidence == 0.4);
  }
}

TEST_CASE("a_fit_that_creeps_is_taken_if_none_came_to_rest") {
  using enum LeafletLawId;
  std::vector<LawFit> fits = {fit_of(bilinear, 1 * mm), fit_of(prot, 0.9 * mm)};
  fits[1].at_rest = false;
  const std::vector<LawFit> one = in_order(fits);
  CHECK(one[0].law == bilinear);
  CHECK(plausible_laws(one).size() == 1);
  fits[0].at_rest = false;
  const std::vector<LawFit> creeping = in_order(fits);
  CHECK(creeping[0].law == prot);
  CHECK(plausible_laws(creeping).size() == 2);
  const Finding tissue = tissue_found(creeping, prot);
  CHECK(tissue.confidence == 0.2);
  CHECK(tissue.sentence.find("(not at rest)") != std::string::npos);
  CHECK(plausible_laws({}).empty());
  CHECK(tissue_found({}, bilinear).source == FindingSource::assumed);
}

TEST_CASE("a_free_edge_that_is_moved_far_out_counts_against_a_law") {
  using enum LeafletLawId;
  // an edge 2 mm too short: 0.5 mm / 1.4 mm of that over 26 of 60 places, 0.47 mm
  CHECK(misfit_of(fit_of(bilinear, 0.7 * mm, 2 * mm)) ==
        about(std::sqrt(0.49 + 26.0 / 60.0 / 1.96) * mm, 1e-12));
  const LawFit soft = fit_of(may_newman_yin, 0.75 * mm);
  CHECK(in_order({fit_of(bilinear, 0.7 * mm), soft})[0].law == bilinear);
  CHECK(in_order({fit_of(bilinear, 0.7 * mm, 2 * mm), soft})[0].law == may_newman_yin);
}

TEST_CASE("laws_up_to_a_quarter_farther_away_are_plausible") {
  using enum LeafletLawId;
  const std::vector<LawFit> laws = plausible_laws(
      {fit_of(bilinear, 0.8 * mm), fit_of(prot, 0.999 * mm), fit_of(may_newman_yin, 1.001 * mm)});
  REQUIRE(laws.size() == 2);
  CHECK(laws[1].law == prot);
}

// Chordae half as long again cannot be made short enough: the factors end at 0.8.
TEST_CASE("a_valve_that_is_far_behind_after_one_search_is_given_up") {
  const PatientGeometry &g = parametric_geometry(200);
  const Valve valve = with_chordae(g, LeafletLawId::bilinear);
  Valve other = valve;
  for (Chord &chord : other.chords) chord.rest_length *= 1.5;
  const ClosedPatient closed = close_patient(valve);
  ClosedSurface given{closed.state.x, valve.triangles.get()};
  given.points.resize(g.sheet.x.size());
  std::vector<double> shares;
  Workers workers(2);
  const std::vector<LawFit> fits = in_order(fit_laws(
      {other, valve}, g, given, true, [&](double share) { shares.push_back(share); }, &workers));
  REQUIRE(fits.size() == 2);
  CHECK_FALSE(fits[0].given_up);
  CHECK(fits[1].given_up);
  CHECK(misfit_of(fits[1]) > 2.5 * misfit_of(fits[0]));
  CHECK(std::is_sorted(shares.begin(), shares.end()));
  CHECK(tissue_found(fits, LeafletLawId::bilinear).sentence.find("(given up)") !=
        std::string::npos);
}

// MVS_TEST_LONG: also the fit of the other law, two thirds of the time;
// tests/cli/test_surface_import.py has the choice between laws in every run.
TEST_CASE("law_of_a_closed_valve_is_found_by_its_surface") {
  const bool is_long = long_run();
  // fewer vertices, 260 or 200, leave 0.6 mm, which is more than the noise
  const PatientGeometry &g = parametric_geometry(320);
  const LeafletLawId truth = LeafletLawId::may_newman_yin;
  Valve valve = with_chordae(g, truth);
  for (Chord &chord : valve.chords) chord.rest_length *= 1.03;
  const ClosedPatient closed = close_patient(valve);
  ClosedSurface given{closed.state.x, valve.triangles.get()};
  given.points.resize(g.sheet.x.size());
  std::vector<Valve> valves = {with_chordae(g, truth)};
  if (is_long) valves.push_back(with_chordae(g, LeafletLawId::bilinear));
  std::vector<double> shares;
  const std::vector<LawFit> fits =
      fit_laws(valves, g, given, false, [&](double share) { shares.push_back(share); });
  REQUIRE(fits.size() == valves.size());
  CHECK(std::is_sorted(shares.begin(), shares.end()));
  CHECK(shares[0] == 0);
  CHECK(shares.back() == 1);
  // its own law meets the surface as well as a fit weighs it
  CHECK(fits[0].distance < FitSettings().noise);
  CHECK(fits[0].rms < FitSettings().noise);
  CHECK(fits[0].factor.size() > 4);
  if (!is_long) return;
  CHECK(fits[1].distance > FitSettings().noise);
  CHECK(in_order(fits)[0].law == truth);
  CHECK(tissue_found(in_order(fits), truth).confidence == 0.6);
}
