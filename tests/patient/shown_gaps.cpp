// Gaps of closed surfaces, against closed forms, and the interval that contains them.
#include "patient/fit/shown_gaps.h"

#include <doctest/doctest.h>

#include <cmath>

#include "patient/doubtful.h"
#include "patient/findings.h"
#include "patient/fit/leak_interval.h"
#include "tests/patient/flat_valve.h"
#include "tests/patient/patient_valve.h"

using namespace mvs::core;
using namespace mvs::core::test;

namespace {

constexpr double mm = 1e-3, mm2 = 1e-6;

// Gaps of a surface in the plane of a valve that is sealed.
ShownGaps gaps_of(const ClosedSurface &given, double error = usual_closed_error) {
  static const Disc valve(0.2 * mm);
  return shown_gaps(given, *valve.model, valve.x(), valve.g, error);
}

ClosedSurface ring(double outer, double inner) {
  const Disc disc(inner, outer);
  return {disc.x(), disc.g.sheet.triangles};
}

// Every triangle with points of its own, and every other one wound the other way.
ClosedSurface soup_of(const ClosedSurface &surface) {
  ClosedSurface soup;
  for (Tri t : surface.triangles) {
    if (soup.triangles.size() % 2 == 1) std::swap(t[0], t[1]);
    const auto first = static_cast<uint32_t>(soup.points.size());
    for (const uint32_t i : t) soup.points.push_back(surface.points[i]);
    soup.triangles.push_back({first, first + 1, first + 2});
  }
  return soup;
}

void remove_near(const Vec3 &centre, double radius, ClosedSurface &surface) {
  std::erase_if(surface.triangles, [&](const Tri &t) {
    return std::any_of(t.begin(), t.end(),
                       [&](uint32_t i) { return (surface.points[i] - centre).norm() < radius; });
  });
}

// A disc whose anterior leaflet stands away from the other one along both of their borders.
ClosedSurface parted(double by) {
  const Disc disc(0.2 * mm);
  const Valve &valve = disc.model->valve;
  ClosedSurface surface{disc.x(), {}};
  for (size_t t = 0; t < valve.triangles.size(); ++t) {
    Tri corners = valve.triangles[t];
    for (uint32_t &i : corners) {
      if (valve.triangle_leaflet[t] != 0) continue;
      surface.points.push_back(surface.points[i] + Vec3(by, 0, 0));
      i = static_cast<uint32_t>(surface.points.size() - 1);
    }
    surface.triangles.push_back(corners);
  }
  return surface;
}

}  // namespace

TEST_CASE("a_gap_that_the_valve_closes_is_measured_on_the_surface") {
  const ClosedSurface surface = ring(16 * mm, 3 * mm);
  for (const ClosedSurface &given : {surface, soup_of(surface)}) {
    const ShownGaps shown = gaps_of(given);
    REQUIRE(shown.gaps.size() == 1);
    CHECK(shown.area == about(hole_area(3 * mm), 1e-3));
    // the widest ball touches the sides of the polygon
    CHECK(shown.gaps[0].width == about(6 * mm * std::cos(pi / 96), 0.01));
    CHECK(shown.most == about(shown.area * (1 + 1.4 * mm / shown.gaps[0].width), 1e-9));
    CHECK(shown.least == about(shown.area * (1 - 1.4 * mm / shown.gaps[0].width), 1e-9));
    CHECK(!shown.gaps[0].place.empty());
  }
}

TEST_CASE("a_surface_may_end_short_of_the_annulus_and_have_holes_far_from_the_free_edge") {
  const double whole = gaps_of(ring(16 * mm, 3 * mm)).area;
  CHECK(gaps_of(ring(13.5 * mm, 3 * mm)).area == about(whole, 1e-3));
  ClosedSurface torn = ring(16 * mm, 3 * mm);
  const size_t all = torn.triangles.size();
  remove_near({0, 13 * mm, 0}, 2 * mm, torn);
  REQUIRE(torn.triangles.size() < all);
  CHECK(gaps_of(torn).area == about(whole, 1e-3));
}

TEST_CASE("a_hole_in_one_leaflet_is_no_gap_between_leaflets") {
  // leaflet A is around +x, its border to P on both sides of it
  for (const double angle : {0.0, pi, Sheet().anterior}) {
    CAPTURE(angle);
    ClosedSurface torn = ring(16 * mm, 0.2 * mm);
    remove_near({6 * mm * std::cos(angle), 6 * mm * std::sin(angle), 0}, 2.5 * mm, torn);
    const ShownGaps shown = gaps_of(torn);
    CHECK(shown.gaps.size() == (angle == Sheet().anterior ? 1 : 0));
  }
}

TEST_CASE("gaps_of_a_surface_without_a_leaflet_are_not_measured") {
  ClosedSurface half = ring(16 * mm, 3 * mm);
  std::erase_if(half.triangles, [&](const Tri &t) { return half.points[t[0]].x() < 0; });
  const ShownGaps shown = gaps_of(half);
  CHECK(shown.missing == "P");
  CHECK(shown.gaps.empty());
  CHECK(shown.most == 0);
  Findings findings;
  report_shown_gaps(shown, 0, findings);
  CHECK(findings[0].value.empty());
  CHECK(findings[0].sentence.find("less than 60 % of leaflet P") != std::string::npos);
}

TEST_CASE("narrow_gaps_are_errors_of_a_surface_and_small_ones_show_nothing") {
  CHECK(gaps_of(ring(16 * mm, 0.85 * mm)).gaps.empty());      // 1.7 mm wide
  CHECK(gaps_of(ring(16 * mm, 0.95 * mm)).gaps.size() == 1);  // 1.9 mm wide
  const ShownGaps small = gaps_of(ring(16 * mm, 1.6 * mm));
  REQUIRE(small.gaps.size() == 1);
  CHECK(small.area == about(hole_area(1.6 * mm), 2e-3));  // 8 mm2, less than 12
  CHECK(small.most == 0);
  Findings findings;
  report_shown_gaps(small, 0, findings);
  CHECK(findings[0].value == std::vector<double>{small.area});
  CHECK(findings[0].sentence.find("errors of a surface show as much") != std::string::npos);
  CHECK(!is_doubtful(findings[0]));
}

TEST_CASE("leaflets_that_touch_with_their_thickness_between_their_middles_are_no_gap") {
  const Disc disc(0.2 * mm);
  for (const double thickness : {0.6 * mm, 1 * mm, 2 * mm}) {
    Valve valve = disc.model->valve;
    for (double &t : valve.triangle_thickness.edit()) t = thickness;
    const ModelPtr model = make_model(valve);
    const ClosedSurface surface = parted(2.1 * mm);
    const ShownGaps shown = shown_gaps(surface, *model, disc.x(), disc.g, usual_closed_error);
    CAPTURE(thickness);
    CHECK(shown.gaps.size() == (thickness < 2 * mm ? 1 : 0));
    CHECK(shown.least_width == about(1.8 * mm + std::max(0.0, thickness - 1 * mm), 1e-12));
  }
}

TEST_CASE("leaflets_that_touch_are_no_gap_of_a_surface_that_is_known_to_be_better") {
  // The middles of tissue of 1 mm are as far apart, and errors of 0.2 mm explain 0.72 mm of that.
  CHECK(gaps_of(parted(1.2 * mm), 0.2 * mm).gaps.empty());
  CHECK(gaps_of(parted(1.6 * mm), 0.2 * mm).gaps.size() == 1);
  // never wider than on the surface of labels, whatever the thickness
  for (const double thickness : {0.5 * mm, 1 * mm, 3 * mm}) {
    for (const double error : {0.05 * mm, 0.2 * mm, 0.4 * mm}) {
      CHECK(least_gap_width(error, thickness) >= std::max(3.6 * error, thickness));
      CHECK(least_gap_width(error, thickness) < least_gap_width(usual_closed_error, thickness));
    }
  }
}

TEST_CASE("a_long_slit_as_wide_as_the_largest_of_ten_errors_is_no_gap") {
  // it ends 10 mm from the free edge on both sides
  const ShownGaps narrow = gaps_of(parted(1.6 * mm)), wide = gaps_of(parted(2.1 * mm));
  CHECK(narrow.gaps.empty());
  CHECK(narrow.most == 0);
  REQUIRE(wide.gaps.size() == 1);
  CHECK(wide.gaps[0].area == about(2 * 10 * mm * 2.1 * mm, 0.1));
  CHECK(wide.gaps[0].width == about(2.1 * mm, 0.03));
}

TEST_CASE("narrow_gaps_are_named_and_count_on_a_surface_that_is_known_to_be_better") {
  const ClosedSurface surface = parted(1.3 * mm);
  const ShownGaps usual = gaps_of(surface), better = gaps_of(surface, 0.1 * mm);
  CHECK(usual.gaps.empty());
  CHECK(usual.narrow_area == about(2 * 10 * mm * 1.3 * mm, 0.1));
  // corners of triangles across the slit lie off its middle
  CHECK(usual.narrow_width == about(1.3 * mm, 0.06));
  REQUIRE(better.gaps.size() == 1);
  CHECK(better.gaps[0].area == usual.narrow_area);
  CHECK(better.narrow_area == 0);
  // tissue of 1 mm counts from 0.9 + 0.5 mm on
  CHECK(gaps_of(surface, 0.25 * mm).gaps.empty());
  Findings findings;
  report_shown_gaps(usual, 0, findings);
  report_shown_gaps(better, 0, findings);
  CHECK(findings[0].sentence.find(" mm wide, do not count: errors of 0.50 mm open as wide ones") !=
        std::string::npos);
  CHECK(findings[1].sentence.find("narrower gaps") == std::string::npos);
  report_closed_error(0, findings);
  CHECK(findings.size() == 2);
  report_closed_error(0.3 * mm, findings);
  CHECK(findings[2].value == std::vector<double>{0.3 * mm});
}

TEST_CASE("small_gaps_of_a_surface_that_is_known_to_be_better_widen_the_interval") {
  const ClosedSurface surface = ring(16 * mm, 1.2 * mm);
  CHECK(gaps_of(surface).most == 0);
  const ShownGaps better = gaps_of(surface, 0.1 * mm);
  REQUIRE(better.gaps.size() == 1);
  // 2.8 deviations, 95 % of the difference of two edges
  CHECK(better.most == about(better.area * (1 + 0.28 * mm / better.gaps[0].width), 1e-9));
}

TEST_CASE("gaps_that_the_fitted_valve_closes_are_doubtful") {
  const ShownGaps shown{{}, {{30 * mm2, 3 * mm, 0, "A2 to P2"}}, 30 * mm2, 16 * mm2, 44 * mm2};
  Findings closed, same, none, open;
  report_shown_gaps(shown, 14 * mm2, closed);
  REQUIRE(closed[0].name == "shown_gaps");
  CHECK(is_doubtful(closed[0]));
  CHECK(closed[0].sentence.find("30.0 mm2, 3.0 mm wide (A2 to P2)") != std::string::npos);
  CHECK(closed[0].sentence.find("leaks 14.0 mm2: its chordae") != std::string::npos);
  for (const double leak : {16 * mm2, 30 * mm2, 87 * mm2}) report_shown_gaps(shown, leak, same);
  for (const Finding &finding : same) CHECK(!is_doubtful(finding));
  report_shown_gaps(shown, 90 * mm2, open);
  CHECK(is_doubtful(open[0]));
  report_shown_gaps({}, 0, none);
  CHECK(!is_doubtful(none[0]));
  CHECK(none[0].value == std::vector<double>{0});
}

TEST_CASE("the_interval_contains_the_gaps_of_the_surface_with_their_error") {
  const ShownGaps shown{{}, {}, 30 * mm2, 16 * mm2, 44 * mm2};
  LeakInterval above, below, around;
  above.least = 57 * mm2, above.most = 160 * mm2;
  below.least = 0, below.most = 3 * mm2;
  around.least = 10 * mm2, around.most = 50 * mm2;
  for (LeakInterval *interval : {&above, &below, &around}) reach_to(shown, *interval);
  CHECK((above.least == 16 * mm2 && above.most == 160 * mm2));
  CHECK((below.least == 0 && below.most == 44 * mm2));
  CHECK((around.least == 10 * mm2 && around.most == 50 * mm2));
  reach_to({}, around);
  CHECK(around.least == 10 * mm2);
}

TEST_CASE("a_gap_does_not_count_where_the_missing_tissue_would_close_it") {
  const PatientGeometry &g = parametric_geometry(430);
  const ParametricSheet p = parametric_sheet(430);
  const ClosedPatient closed = close_patient(p.model->valve);
  const auto measured = [&](const ClosedSurface &given) {
    return shown_gaps(given, *p.model, closed.state.x, g, usual_closed_error);
  };
  // the posterior leaflet, 13 to 15 mm high, lacks all but 8 mm, without which it overlapped the
  // anterior one; or it has all and stands 5 mm away
  const Valve &valve = p.model->valve;
  ClosedSurface eaten{closed.state.x, {}}, apart{closed.state.x, g.sheet.triangles};
  for (size_t t = 0; t < valve.triangles.size(); ++t) {
    const Tri &c = valve.triangles[t];
    const bool is_posterior = valve.triangle_leaflet[t] == 1;
    const auto is_high = [&](uint32_t i) { return g.coordinates.height[i] <= 8 * mm; };
    if (!is_posterior || std::all_of(c.begin(), c.end(), is_high)) eaten.triangles.push_back(c);
    for (const uint32_t i : c) {
      const double share = std::min(1.0, g.coordinates.height[i] / (5 * mm));
      if (is_posterior) apart.points[i].y() = closed.state.x[i].y() - share * 5 * mm;
    }
  }
  const ShownGaps whole = measured(apart);
  REQUIRE(!whole.gaps.empty());
  CHECK(whole.gaps[0].missing < whole.gaps[0].width);
  CHECK(whole.area > 0);
  const ShownGaps lacks = measured(eaten);
  REQUIRE(!lacks.gaps.empty());
  CHECK(lacks.gaps[0].missing > lacks.gaps[0].width + 1.5 * mm);
  CHECK(lacks.area == 0);
  CHECK(lacks.most == 0);
  Findings findings;
  report_shown_gaps(lacks, 0, findings);
  CHECK(findings[0].sentence.find("of tissue are missing beside it") != std::string::npos);
  CHECK(!is_doubtful(findings[0]));
}

TEST_CASE("the_interval_of_a_sealed_valve_reaches_to_the_gap_of_its_surface") {
  const PatientGeometry &g = parametric_geometry(430);
  const ParametricSheet whole = parametric_sheet(430);
  const ClosedPatient closed = close_patient(whole.model->valve);
  ClosedSurface given{closed.state.x, g.sheet.triangles};
  LeakUnknowns unknowns;
  unknowns.lengths.all = unknowns.lengths.single = 0.01;
  unknowns.shape = {&given, &g};
  Findings findings;
  const LeakInterval sealed = leak_interval(whole.model, unknowns, {}, findings);
  CHECK(find_finding(findings, "shown_gaps")->value == std::vector<double>{0});
  // tissue of both leaflets is missing around a point of the free edge
  const std::vector<uint32_t> &edge = g.rims.free_edge;
  const auto lowest = std::min_element(edge.begin(), edge.end(), [&](uint32_t a, uint32_t b) {
    return closed.state.x[a].z() < closed.state.x[b].z();
  });
  remove_near(closed.state.x[*lowest], 10 * mm, given);
  findings.clear();
  const LeakInterval torn = leak_interval(whole.model, unknowns, {}, findings);
  const Finding *gaps = find_finding(findings, "shown_gaps");
  REQUIRE(gaps != nullptr);
  CHECK(is_doubtful(*gaps));
  CHECK(torn.leak == sealed.leak);
  CHECK(sealed.most < gaps->value[0]);
  CHECK(torn.most > gaps->value[0]);
  CHECK(find_finding(findings, "leak_interval")->sentence.find("has gaps of ") !=
        std::string::npos);
}
