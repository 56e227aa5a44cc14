// Chord lengths from a closed surface: twin experiments, groups, normal equations; leak interval.
#include "patient/fit/fit_to_closed.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "ensemble/loading_path.h"
#include "geometry/intersect.h"
#include "patient/fit/free_edge_shift.h"
#include "patient/fit/leak_interval.h"
#include "patient/fit/normal_equations.h"
#include "patient/fit/thickness_range.h"
#include "tests/about.h"
#include "tests/patient/patient_valve.h"

using namespace mvs::core;
using namespace mvs::core::test;

namespace {

constexpr double mm = 1e-3;

double known_factor(const ChordGroup &group) {
  if (group.name[0] == 'A') return 0.93;
  return group.name == "P marginal" ? 1.06 : 1;
}

// Closed along a path of its own: a disturbed start, four increments of the pressure.
std::vector<Vec3> closed_elsewhere(const Model &model) {
  Solver solver(Backend::fastest);
  const Path path = make_path(1, {0.5 * mm, 5 * mm}, 7);
  return close_along(solver, model, initial_state(model), {systolic_pressure, 1}, {}, path, {})
      .state.x;
}

}  // namespace

TEST_CASE("bounded_normal_equations_meet_their_conditions") {
  DenseMatrix h(3);
  h.entry = {4, 1, 0, 1, 3, -1, 0, -1, 2};
  const std::vector<double> b = {1, 2, 3};
  const std::vector<double> x = solve_dense(h, b);
  for (size_t i = 0; i < 3; ++i) {
    double sum = -b[i];
    for (size_t j = 0; j < 3; ++j) sum += h.at(i, j) * x[j];
    CHECK(std::abs(sum) < 1e-14);  // rounding
  }
  // x is about (-0.17, 1.67, 2.33): the second variable meets its bound
  const std::vector<double> y = solve_bounded(h, b, {-1, -1, -9}, {9, 0.5, 9});
  CHECK(y[1] == 0.5);
  CHECK(y[0] == about((1 - 0.5) / 4));
  CHECK(y[2] == about((3 + 0.5) / 2));
  // the determinant is 18; the cofactors of the diagonal are 5, 8 and 11
  const std::vector<double> inverse = inverse_diagonal(h);
  CHECK(inverse[0] == about(5.0 / 18));
  CHECK(inverse[1] == about(8.0 / 18));
  CHECK(inverse[2] == about(11.0 / 18));
}

TEST_CASE("chordae_are_grouped_by_leaflet_kind_and_muscle") {
  const ModelPtr model = make_model(patient_valve(430));
  for (const ChordGrouping grouping : {ChordGrouping::kinds, ChordGrouping::halves}) {
    const std::vector<ChordGroup> groups = chord_groups(*model, grouping);
    const bool halves = grouping == ChordGrouping::halves;
    CHECK(groups.size() == (halves ? 14 : 7));
    std::vector<int> uses(model->valve.chords.size(), 0);
    for (const ChordGroup &group : groups) {
      for (const uint32_t c : group.chords) {
        ++uses[c];
        const Chord &chord = model->valve.chords[c];
        if (halves && model->topology.node_kind[chord.a] == NodeKind::head) {
          const bool medial = model->valve.rest[chord.a].x() > 0;
          CHECK(group.name.substr(group.name.size() - 2) == (medial ? "PM" : "AL"));
        }
        if (chord.kind == ChordKind::strut) CHECK(group.name.substr(0, 7) == "A strut");
        if (chord.kind == ChordKind::basal) CHECK(group.name.substr(0, 7) == "P basal");
      }
    }
    CHECK(std::count(uses.begin(), uses.end(), 1) == static_cast<std::ptrdiff_t>(uses.size()));
  }
}

TEST_CASE("lengths_that_were_changed_are_found_from_the_closed_surface") {
  const Valve valve = patient_valve(430);
  const std::vector<ChordGroup> groups = chord_groups(*make_model(valve), ChordGrouping::kinds);
  std::vector<double> known;
  known.reserve(groups.size());
  for (const ChordGroup &group : groups) known.push_back(known_factor(group));
  Valve truth = valve;
  scale_groups(truth, groups, known);
  Solver solver(Backend::fastest);
  const ClosedValve target = close_open(solver, make_model(truth), systolic_pressure);
  ClosedSurface surface{target.state.x, valve.triangles};
  // segmentations are wound either way
  for (Tri &t : surface.triangles) std::swap(t[1], t[2]);

  Valve fitted = valve;
  FitSettings settings;
  settings.grouping = ChordGrouping::kinds;
  settings.one_by_one = false;
  settings.starts = 1;
  Findings findings;
  const ChordFit fit = fit_to_closed(fitted, surface, settings, findings);
  CHECK(fit.at_rest);
  CHECK(fit.rms_before > 1 * mm);
  CHECK(fit.rms < 0.3 * mm);
  for (size_t k = 0; k < groups.size(); ++k) {
    CAPTURE(groups[k].name);
    // 0.03: 0.4 mm of a chord of 15 mm; neighbouring rows share so much of their pull. Chordae that
    // are nearly slack are open by more, which the deviation says
    CHECK(std::abs(fit.factor[k] - known[k]) < std::max(0.03, 2 * fit.deviation[k]));
  }
  REQUIRE(findings.size() == 4);
  CHECK(findings[0].value[0] == fit.rms);
  CHECK(findings[1].value == fit.factor);

  const ModelPtr model = make_model(fitted);
  CHECK(distance_from(surface, *model, closed_elsewhere(*model)) < 0.3 * mm);
}

TEST_CASE("closed_surfaces_of_another_frame_are_refused") {
  Valve valve = patient_valve(200);
  Findings findings;
  ClosedSurface surface{valve.rest, valve.triangles};
  for (Vec3 &p : surface.points) p += Vec3(0, 0, 0.1);
  CHECK_THROWS_WITH_AS(fit_to_closed(valve, surface, {}, findings), doctest::Contains("LPS or RAS"),
                       Error);
  CHECK_THROWS_WITH_AS(fit_to_closed(valve, {surface.points, {}}, {}, findings),
                       doctest::Contains("no triangles"), Error);
  CHECK_THROWS_WITH_AS(fit_to_closed(valve, {surface.points, {{0, 1, 9999}}}, {}, findings),
                       doctest::Contains("9999"), Error);
}

TEST_CASE("the_open_surface_is_refused_as_the_closed_one") {
  Valve valve = patient_valve(200);
  Findings findings;
  ClosedSurface surface{valve.rest, valve.triangles};
  for (Vec3 &p : surface.points) p += Vec3(0, 0, 0.3 * mm);
  CHECK_THROWS_WITH_AS(fit_to_closed(valve, surface, {}, findings),
                       doctest::Contains("lies on the open one"), Error);
}

TEST_CASE("a_leak_comes_with_those_of_shorter_and_longer_chordae") {
  Valve valve = patient_valve(200);
  // chordae that are a quarter too short hold the leaflets apart
  for (Chord &chord : valve.chords) chord.rest_length *= 0.75;
  Findings findings;
  const LeakInterval interval = leak_interval(make_model(valve), {}, {}, findings);
  const ClosedPatient closed = close_patient(valve);
  CHECK(interval.leak[1] == measure_orifice(*closed.model, closed.state.x).area);
  const auto [least, most] = std::minmax_element(interval.leak.begin(), interval.leak.end());
  CHECK(*most > *least + 1e-6);
  REQUIRE(findings.size() == 3);
  CHECK(findings[0].name == "leak");
  CHECK(findings[1].name == "leak_interval");
  CHECK(findings[2].name == "leak_limits");
  CHECK(interval.draws > 0);
  CHECK(interval.least <= *least);
  CHECK(interval.most > *most);
  CHECK(findings[0].value == std::vector<double>(interval.leak.begin(), interval.leak.end()));
  CHECK(findings[0].unit == "m2");
  CHECK(findings[0].confidence < 0.8);  // that of a leak which does not depend on the lengths
}

TEST_CASE("after_a_fit_all_lengths_together_vary_as_the_mean_of_the_groups") {
  ChordFit fit;
  fit.deviation = {0.02, 0.02, 0.04, 0.2};
  const LengthRange range = range_after(fit);
  REQUIRE(range.group.size() == 4);
  CHECK(range.group[0] == about(std::sqrt(3.0) * 0.02));
  CHECK(range.group[3] == 0.1);  // not wider than without a fit
  // the variances of 3 * (0.02^2, 0.02^2, 0.04^2) and 0.1^2 add up for a sum of independent factors
  CHECK(range.all == about(std::sqrt(3 * 0.0024 + 0.01) / 4));
}

TEST_CASE("a_free_edge_moves_by_its_error_and_chordae_follow") {
  const PatientGeometry &g = parametric_geometry(430);
  const Valve valve = patient_valve(430);
  for (const double by : {1 * mm, -1 * mm}) {
    const Valve moved = with_edge_moved(valve, g, by);
    const std::vector<Vec3> &x = moved.rest.get();
    PatientGeometry other = g;
    std::copy_n(x.begin(), other.sheet.x.size(), other.sheet.x.begin());
    const SheetCoordinates c = sheet_coordinates(other.sheet, g.rims);
    double grown = 0;
    for (const uint32_t i : g.rims.free_edge) grown += c.whole[i] - g.coordinates.whole[i];
    // coordinates are exact to some percent of the height; commissures move less
    CHECK(grown / static_cast<double>(g.rims.free_edge.size()) == about(by, 0.25));
    for (const uint32_t i : g.rims.annulus) CHECK(x[i] == valve.rest.get()[i]);
    CHECK(find_intersections(other.sheet.x, other.sheet.triangles).empty());
    for (size_t k = 0; k < valve.chords.size(); ++k) {
      const Chord &was = valve.chords[k], &is = moved.chords[k];
      const double before = (valve.rest.get()[was.b] - valve.rest.get()[was.a]).norm();
      const double after = (x[is.b] - x[is.a]).norm();
      // rounding of lengths of some 10 mm
      CHECK(std::abs(is.rest_length - was.rest_length - (after - before)) < 1e-16);
    }
  }
  CHECK(with_edge_moved(valve, g, 0).rest.get() == valve.rest.get());
}

TEST_CASE("an_edge_that_is_not_sure_widens_the_interval_of_leaks") {
  const PatientGeometry &g = parametric_geometry(200);
  Valve valve = patient_valve(200);
  for (Chord &chord : valve.chords) chord.rest_length *= 0.75;
  Findings exact, unsure;
  const LeakInterval sure = leak_interval(make_model(valve), {}, {}, exact);
  Workers workers(3);
  const LeakInterval wide =
      leak_interval(make_model(valve), {{}, {2 * mm, 1 * mm, &g}, 0, {}}, {}, unsure, {}, &workers);
  CHECK(wide.leak == sure.leak);
  CHECK(sure.edge_leak[0] == 0);
  // leaflets that are longer leak less; shorter ones hang on longer chordae, and may leak less as
  // well
  CHECK(wide.edge_leak[0] < wide.leak[1]);
  for (const double leak : wide.edge_leak) {
    CHECK(wide.least <= leak);
    CHECK(wide.most >= leak);
  }
  CHECK(unsure[1].sentence.find("2.0 mm farther out") != std::string::npos);
  CHECK(exact[1].sentence.find("farther") == std::string::npos);
}

TEST_CASE("a_thickness_that_is_not_sure_widens_the_interval_of_leaks") {
  Valve valve = patient_valve(200);
  for (Chord &chord : valve.chords) chord.rest_length *= 0.75;
  Findings exact, unsure;
  const ModelPtr model = make_model(valve);
  const LeakInterval sure = leak_interval(model, {}, {}, exact);
  const LeakInterval wide = leak_interval(model, {{}, {}, 0.3 * mm, {}}, {}, unsure);
  CHECK(wide.leak == sure.leak);
  CHECK(sure.tissue_leak[0] == 0);
  // that of a valve built so much thicker
  const double factor = 1 + 0.3 * mm / mean_thickness(valve);
  const ClosedPatient thick = close_patient(with_thickness(valve, factor));
  CHECK(wide.tissue_leak[0] == measure_orifice(*thick.model, thick.state.x).area);
  for (const double leak : wide.tissue_leak) {
    CHECK(wide.least <= leak);
    CHECK(wide.most >= leak);
  }
  CHECK(unsure[1].sentence.find("0.30 mm thicker") != std::string::npos);
  CHECK(exact[1].sentence.find("thicker") == std::string::npos);
}
