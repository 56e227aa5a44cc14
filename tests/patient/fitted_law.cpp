// The tissue law by a closed surface: the choice among fits, and fits of valves of known tissue.
#include "patient/fit/fitted_law.h"

#include <doctest/doctest.h>

#include "patient/findings.h"
#include "patient/fit/closure.h"
#include "tests/patient/patient_valve.h"

using namespace mvs::core;
using namespace mvs::core::test;

namespace {

constexpr double mm = 1e-3, mm2 = 1e-6;

LawFit fit_of(LeafletLawId law, double distance, double leak = 0, double edge = 0) {
  LawFit fit;
  fit.law = law;
  fit.distance = distance;
  fit.leak = leak;
  fit.edge = edge;
  fit.factor["A marginal, AL"] = 1 + distance;
  return fit;
}

Valve with_chordae(const PatientGeometry &g, LeafletLawId law) {
  Findings findings;
  Valve valve = leaflets_of(g, law);
  add_chordae(valve, g, find_papillary_tips({}, g, findings), {}, findings);
  return valve;
}

}  // namespace

TEST_CASE("law_of_the_nearest_fit_is_taken_if_it_is_a_tenth_nearer_than_the_default") {
  using enum LeafletLawId;
  Findings findings;
  const LawChoice far = choose_law({fit_of(bilinear, 1 * mm), fit_of(prot, 0.901 * mm)}, findings);
  CHECK(far.law == bilinear);
  const LawChoice near = choose_law({fit_of(bilinear, 1 * mm), fit_of(prot, 0.899 * mm)}, findings);
  CHECK(near.law == prot);
  CHECK(near.factor.at("A marginal, AL") == 1 + 0.899 * mm);
  REQUIRE(findings.size() == 2);
  CHECK(findings[1].name == "tissue");
  CHECK(findings[1].source == FindingSource::guessed);
  CHECK(findings[1].value == std::vector<double>{static_cast<double>(prot)});
  // surer where no other law is about as near
  choose_law({fit_of(bilinear, 1.3 * mm), fit_of(may_newman_yin, 0.8 * mm)}, findings);
  choose_law(
      {fit_of(bilinear, 1.3 * mm), fit_of(prot, 0.85 * mm), fit_of(may_newman_yin, 0.8 * mm)},
      findings);
  CHECK(findings[2].confidence > findings[3].confidence);
  CHECK(findings[2].value == findings[3].value);
}

TEST_CASE("without_a_fit_of_the_default_the_nearest_law_is_taken_and_without_any_the_default") {
  using enum LeafletLawId;
  Findings findings;
  CHECK(choose_law({fit_of(may_newman_yin, 2 * mm), fit_of(prot, 1.99 * mm)}, findings).law ==
        prot);
  const LawChoice none = choose_law({}, findings);
  CHECK(none.law == bilinear);
  CHECK(none.leaks.empty());
  CHECK(none.factor.empty());
  CHECK(findings.back().source == FindingSource::assumed);
}

TEST_CASE("a_free_edge_that_is_moved_far_out_counts_against_a_law") {
  using enum LeafletLawId;
  Findings findings;
  // an edge 2 mm too short: 0.5 mm / 1.4 mm of that over 26 of 60 places, 0.47 mm
  CHECK(misfit_of(fit_of(bilinear, 0.7 * mm, 0, 2 * mm)) ==
        doctest::Approx(std::sqrt(0.49 + 26.0 / 60.0 / 1.96) * mm).epsilon(1e-12));
  const LawFit soft = fit_of(may_newman_yin, 0.65 * mm);
  CHECK(choose_law({fit_of(bilinear, 0.7 * mm), soft}, findings).law == bilinear);
  CHECK(choose_law({fit_of(bilinear, 0.7 * mm, 0, 2 * mm), soft}, findings).law == may_newman_yin);
}

TEST_CASE("leaks_of_laws_up_to_a_quarter_farther_away_are_plausible") {
  using enum LeafletLawId;
  Findings findings;
  const LawChoice choice =
      choose_law({fit_of(bilinear, 0.8 * mm, 5 * mm2), fit_of(prot, 0.999 * mm, 9 * mm2),
                  fit_of(may_newman_yin, 1.001 * mm, 40 * mm2)},
                 findings);
  CHECK(choice.leaks == std::vector<double>{5 * mm2, 9 * mm2});
}

TEST_CASE("law_of_a_closed_valve_is_found_by_its_surface") {
  const PatientGeometry &g = parametric_geometry(430);
  const LeafletLawId truth = LeafletLawId::may_newman_yin;
  Valve valve = with_chordae(g, truth);
  for (Chord &chord : valve.chords) chord.rest_length *= 1.03;
  const ClosedPatient closed = close_patient(valve);
  ClosedSurface given{closed.state.x, valve.triangles.get()};
  given.points.resize(g.sheet.x.size());
  std::vector<LawFit> fits;
  uint32_t searches = 0;
  for (const LeafletLawId law : {LeafletLawId::bilinear, truth}) {
    const std::optional<LawFit> fit =
        fit_law(with_chordae(g, law), g, given, false, [&](uint32_t search) {
          CHECK(search < law_searches);
          ++searches;
        });
    REQUIRE(fit);
    fits.push_back(*fit);
  }
  CHECK(searches == 2 * law_searches);
  // its own law meets the surface as well as a fit weighs it, the other one does not
  CHECK(fits[1].distance < FitSettings().noise);
  CHECK(fits[0].distance > FitSettings().noise);
  Findings findings;
  CHECK(choose_law(fits, findings).law == truth);
  CHECK(findings[0].confidence == 0.6);
}
