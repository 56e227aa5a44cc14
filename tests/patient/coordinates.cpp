// Coordinates on a sheet, commissures and scallops, beside the formulas of the parametric valve.
#include "patient/coordinates.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <numeric>

#include "base/error.h"
#include "measure/annulus/landmarks.h"
#include "model/sides.h"
#include "patient/findings.h"
#include "patient/leaflet_heights.h"
#include "patient/leaflets.h"
#include "patient/surface/mirrored.h"
#include "tests/patient/parametric_sheet.h"

using namespace mvs::core;
using namespace mvs::core::test;

namespace {

Mat3 turn_of(double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  Mat3 turn;
  turn << c, -s, 0, s, c, 0, 0, 0, 1;
  Mat3 tilt;
  tilt << 1, 0, 0, 0, c, -s, 0, s, c;
  return turn * tilt;
}

// Share of the area whose scallop differs from that of the generated valve.
double misnamed_share(const ParametricSheet &p, const SheetCoordinates &c,
                      const LeafletArcs &arcs) {
  const Valve &valve = p.model->valve;
  double wrong = 0, all = 0;
  for (size_t t = 0; t < p.sheet.triangles.size(); ++t) {
    const Tri &tri = p.sheet.triangles[t];
    const double area = triangle_area(p.sheet.x, tri);
    all += area;
    if (scallop_of(arcs, triangle_foot(c, tri), c.annulus_length) != valve.triangle_scallop[t]) {
      wrong += area;
    }
  }
  return wrong / all;
}

}  // namespace

TEST_CASE("lengths_around_a_loop_are_wrapped") {
  CHECK(wrapped(-0.25, 1) == 0.75);
  CHECK(wrapped(2.5, 1) == 0.5);
  CHECK(around(0.9, 0.1, 1) == doctest::Approx(0.2));
  CHECK(around(0.1, 0.9, 1) == doctest::Approx(-0.2));
}

TEST_CASE("heights_at_the_middles_of_the_leaflets_are_the_given_dimensions") {
  for (const uint32_t vertices : {430u, 1600u}) {
    const ParametricSheet p = parametric_sheet(vertices);
    const SheetCoordinates c = sheet_coordinates(p.sheet, p.rims);
    double anterior = 0, posterior = 0, lowest = 1;
    for (const uint32_t i : p.rims.free_edge) {
      (p.sheet.x[i].y() > 0 ? anterior : posterior) =
          std::max(c.whole[i], p.sheet.x[i].y() > 0 ? anterior : posterior);
      lowest = std::min(lowest, c.whole[i]);
    }
    CAPTURE(vertices);
    // defaults of 25, 14 and 8 mm; the highest place of the anterior edge is A2
    CHECK(anterior == doctest::Approx(25e-3).epsilon(0.03));
    CHECK(lowest < 9.5e-3);
    CHECK(lowest > 6e-3);
    for (size_t i = 0; i < p.sheet.x.size(); ++i) {
      CHECK(c.share[i] >= 0);
      CHECK(c.share[i] <= 1);
      CHECK(c.foot[i] >= 0);
      CHECK(c.foot[i] < c.annulus_length);
    }
    for (const uint32_t i : p.rims.annulus) CHECK(c.height[i] == 0);
    for (const uint32_t i : p.rims.free_edge) CHECK(c.share[i] == 1);
  }
}

TEST_CASE("a_corner_with_neighbours_on_the_rim_alone_lies_beside_them") {
  // triangles with two sides on the free edge, as coarse and torn surfaces have them: no fibre ends
  // at such a corner, which had the height 0 and the foot 0
  ParametricSheet p = parametric_sheet(430);
  const SheetCoordinates plain = sheet_coordinates(p.sheet, p.rims);
  const std::vector<double> heights = height_profile(p.rims, plain, 120);
  std::vector<uint32_t> edge;
  for (size_t k = 0; k < p.rims.free_edge.size(); ++k) {
    const std::vector<uint32_t> &rim = p.rims.free_edge;
    const uint32_t a = rim[k], b = rim[(k + 1) % rim.size()];
    edge.push_back(a);
    if (k % 10 != 0) continue;
    const uint32_t corner = static_cast<uint32_t>(p.sheet.x.size());
    p.sheet.x.push_back(0.5 * (p.sheet.x[a] + p.sheet.x[b]) - Vec3(0, 0, 0.5e-3));
    p.sheet.triangles.push_back({b, a, corner});
    p.sheet.label.push_back(LeafletLabel::unknown);
    edge.push_back(corner);
  }
  p.rims.free_edge = edge;
  const SheetCoordinates c = sheet_coordinates(p.sheet, p.rims);
  for (size_t i = plain.foot.size(); i < p.sheet.x.size(); ++i) {
    const Tri &t = p.sheet.triangles[p.sheet.triangles.size() - (p.sheet.x.size() - i)];
    const double away = std::min(std::abs(around(c.foot[t[0]], c.foot[i], c.annulus_length)),
                                 std::abs(around(c.foot[t[1]], c.foot[i], c.annulus_length)));
    CHECK(away < 1e-12);
    CHECK(c.whole[i] > std::min(c.whole[t[0]], c.whole[t[1]]));
    CHECK(c.share[i] == 1);
  }
  const std::vector<double> with_corners = height_profile(p.rims, c, 120);
  for (size_t k = 0; k < heights.size(); ++k) {
    CHECK(with_corners[k] > heights[k] - 1e-9);
    CHECK(with_corners[k] < heights[k] + 2e-3);  // sides of 2 mm
  }
}

TEST_CASE("coordinates_move_with_the_sheet") {
  ParametricSheet p = parametric_sheet(430);
  const SheetCoordinates before = sheet_coordinates(p.sheet, p.rims);
  const Mat3 turn = turn_of(0.7);
  for (Vec3 &x : p.sheet.x) x = turn * x + Vec3(0.1, -0.2, 0.3);
  const SheetCoordinates after = sheet_coordinates(p.sheet, p.rims);
  // 1 nm: rounding of positions of 0.3 m, carried over 20 triangles
  for (size_t i = 0; i < p.sheet.x.size(); ++i) {
    CHECK(std::abs(around(before.foot[i], after.foot[i], before.annulus_length)) < 1e-9);
    CHECK(std::abs(before.height[i] - after.height[i]) < 1e-9);
  }
}

TEST_CASE("commissures_and_scallops_are_found_without_landmarks") {
  for (const uint32_t vertices : {430u, 1600u}) {
    const ParametricSheet p = parametric_sheet(vertices);
    const SheetCoordinates c = sheet_coordinates(p.sheet, p.rims);
    Findings findings;
    const LeafletArcs arcs = find_leaflets(p.sheet, p.rims, c, {}, findings);
    REQUIRE(findings.size() == 2);
    CHECK(findings[0].source == FindingSource::guessed);
    CHECK(findings[0].confidence > 0.5);
    // x is posteromedial: the first commissure reported is the anterolateral one; the generated
    // ones lie at x = +-17.5 mm
    CHECK(findings[0].value[0] < -15e-3);
    CHECK(findings[0].value[3] > 15e-3);
    CHECK(findings[1].value[1] > 8e-3);  // A2 is at y = 13 mm
    CAPTURE(vertices);
    // scallops are split by angle there and by arc length here; one row of triangles along all six
    // borders is 5 % of the area of the coarse valve, 3 % of the fine one
    CHECK(misnamed_share(p, c, arcs) < 0.06);
  }
}

TEST_CASE("landmarks_that_were_found_give_the_same_leaflets_when_they_are_given") {
  const ParametricSheet p = parametric_sheet(430);
  const SheetCoordinates c = sheet_coordinates(p.sheet, p.rims);
  Findings first, second;
  const LeafletArcs found = find_leaflets(p.sheet, p.rims, c, {}, first);
  const auto point = [](const std::vector<double> &v, size_t k) {
    return Vec3(v[3 * k], v[3 * k + 1], v[3 * k + 2]);
  };
  const LeafletLandmarks landmarks = {
      {point(first[0].value, 0), point(first[0].value, 1)}, {point(first[1].value, 0)}, {}};
  const LeafletArcs given = find_leaflets(p.sheet, p.rims, c, landmarks, second);
  CHECK(given.from == found.from);
  CHECK(given.to == found.to);
  CHECK(second[0].source == FindingSource::given);
  CHECK(second[0].value == first[0].value);
}

TEST_CASE("commissures_given_beside_the_surface_are_doubted") {
  const ParametricSheet p = parametric_sheet(430);
  const SheetCoordinates c = sheet_coordinates(p.sheet, p.rims);
  Findings guessed;
  find_leaflets(p.sheet, p.rims, c, {}, guessed);
  std::vector<Vec3> points = points_in(*find_finding(guessed, "commissures"));
  for (const double above : {2e-3, 6e-3}) {
    std::vector<Vec3> moved = points;
    for (Vec3 &x : moved) x.z() += above;
    Findings found;
    find_leaflets(p.sheet, p.rims, c, {moved, {}, {}}, found);
    const Finding &said = *find_finding(found, "commissures");
    CHECK(said.source == FindingSource::given);
    CHECK(said.confidence == doctest::Approx(std::min(1.0, 3e-3 / above)).epsilon(0.02));
    CHECK((said.sentence.find("of this patient") != std::string::npos) == (above > 3e-3));
  }
}

TEST_CASE("commissures_given_in_the_middle_of_the_leaflets_are_doubted") {
  const ParametricSheet p = parametric_sheet(430);
  const SheetCoordinates c = sheet_coordinates(p.sheet, p.rims);
  Findings guessed;
  const LeafletArcs arcs = find_leaflets(p.sheet, p.rims, c, {}, guessed);
  const double length = c.annulus_length, quarter = 0.5 * (arcs.to - arcs.from);
  const Loop annulus(p.rims.annulus, p.sheet.x);
  // turned by a quarter they are the middles of both leaflets; landmarks by hand are a few mm off
  for (const double turn : {0.0, 0.2, 1.0}) {
    const std::vector<Vec3> points = {
        annulus.at(std::fmod(arcs.from + turn * quarter, length)),
        annulus.at(std::fmod(arcs.to + turn * (0.5 * length - quarter), length))};
    Findings found;
    find_leaflets(p.sheet, p.rims, c, {points, {}, {}}, found);
    const Finding &said = *find_finding(found, "commissures");
    CAPTURE(turn);
    CHECK((said.confidence < 0.5) == (turn == 1));
    CHECK((said.confidence == 1) == (turn < 1));
    CHECK((said.sentence.find("in the middle of the free edges") != std::string::npos) ==
          (turn == 1));
  }
}

TEST_CASE("commissures_in_the_other_frame_are_named_so") {
  // near the origin, where mirrored points are near the surface too, and far from it
  for (const double away : {2e-3, 0.2}) {
    CAPTURE(away);
    ParametricSheet p = parametric_sheet(430);
    for (Vec3 &x : p.sheet.x) x += Vec3(away, 1.5e-3, 0);
    const SheetCoordinates c = sheet_coordinates(p.sheet, p.rims);
    Findings guessed, found;
    find_leaflets(p.sheet, p.rims, c, {}, guessed);
    std::vector<Vec3> points = mirrored(points_in(*find_finding(guessed, "commissures")));
    if (away > 0.1) {
      CHECK_THROWS_WITH_AS(find_leaflets(p.sheet, p.rims, c, {points, {}, {}}, found),
                           doctest::Contains("in the other frame"), Error);
      continue;
    }
    find_leaflets(p.sheet, p.rims, c, {points, {}, {}}, found);
    const Finding &given = *find_finding(found, "commissures");
    CHECK(given.confidence <= 0.1);
    CHECK(given.sentence.find("in the other frame") != std::string::npos);
  }
}

TEST_CASE("places_as_low_as_the_commissures_are_counted") {
  constexpr size_t n = 120;
  const auto heights = [](size_t leaflets) {
    std::vector<double> height;
    for (size_t k = 0; k < n; ++k) {
      const double u = static_cast<double>(k * leaflets % n) / n;
      height.push_back(4e-3 + 40e-3 * u * (1 - u));
    }
    return height;
  };
  CHECK(other_low_places(heights(2), 0, 60) == 0);
  CHECK(other_low_places(heights(3), 0, 40) == 1);
  CHECK(other_low_places(heights(4), 0, 60) == 2);
  std::vector<double> shallow = heights(2);
  for (size_t k = 85; k < 96; ++k) shallow[k] *= 0.8;  // an indentation
  CHECK(other_low_places(shallow, 0, 60) == 0);
}

TEST_CASE("labels_give_the_commissures_also_if_some_are_wrong") {
  ParametricSheet p = parametric_sheet(1600);
  const SheetCoordinates c = sheet_coordinates(p.sheet, p.rims);
  const Valve &valve = p.model->valve;
  for (size_t t = 0; t < p.sheet.label.size(); ++t) {
    const bool swapped = t % 10 == 3;  // a tenth of the labels, everywhere
    p.sheet.label[t] = (valve.triangle_leaflet[t] == 0) != swapped ? LeafletLabel::anterior
                                                                   : LeafletLabel::posterior;
  }
  Findings findings;
  const LeafletArcs arcs = find_leaflets(p.sheet, p.rims, c, {}, findings);
  CHECK(findings[0].source == FindingSource::measured);
  CHECK(findings[0].confidence == doctest::Approx(0.9).epsilon(0.03));
  const Loop annulus(p.rims.annulus, p.sheet.x);
  // the border of the labels is at x = +-17.5 mm, y of 4 mm; half a sample is 0.4 mm, a triangle 1
  // mm
  for (const double s : {arcs.from, arcs.to}) {
    CHECK(std::abs(annulus.at(s).x()) == doctest::Approx(17.5e-3).epsilon(0.1));
  }
}

TEST_CASE("leaflets_that_are_said_to_be_swapped_are_doubted") {
  ParametricSheet p = parametric_sheet(1600);
  const SheetCoordinates c = sheet_coordinates(p.sheet, p.rims);
  const Valve &valve = p.model->valve;
  std::vector<Vec3> tips;
  for (const Head &head : valve.heads) tips.push_back(valve.rest[head.node]);
  for (const bool swapped : {false, true}) {
    for (size_t t = 0; t < p.sheet.label.size(); ++t) {
      p.sheet.label[t] = (valve.triangle_leaflet[t] == 0) != swapped ? LeafletLabel::anterior
                                                                     : LeafletLabel::posterior;
    }
    Findings findings;
    find_leaflets(p.sheet, p.rims, c, {{}, {}, tips}, findings);
    CAPTURE(findings[1].sentence);
    CHECK(findings[1].source == FindingSource::measured);
    CHECK((findings[1].confidence < 0.1) == swapped);
    CHECK((findings[1].sentence.find("are both leaflets swapped?") != std::string::npos) ==
          swapped);
  }
}

TEST_CASE("leaflets_that_cannot_be_told_apart_are_refused") {
  ParametricSheet p = parametric_sheet(430);
  const SheetCoordinates c = sheet_coordinates(p.sheet, p.rims);
  Findings findings;
  p.sheet.label.assign(p.sheet.triangles.size(), LeafletLabel::anterior);
  CHECK_THROWS_WITH_AS(find_leaflets(p.sheet, p.rims, c, {}, findings),
                       doctest::Contains("one leaflet only"), Error);
  for (size_t t = 0; t < p.sheet.label.size(); ++t) {  // no pattern that follows the sheet
    p.sheet.label[t] = (t * t + t / 7) % 3 == 0 ? LeafletLabel::anterior : LeafletLabel::posterior;
  }
  CHECK_THROWS_WITH_AS(find_leaflets(p.sheet, p.rims, c, {}, findings),
                       doctest::Contains("do not show two leaflets"), Error);
  p.sheet.label.assign(p.sheet.triangles.size(), LeafletLabel::unknown);
  // LPS for RAS: x and y negated about an origin that is not the valve
  LeafletLandmarks far = {{Vec3(-0.12, 0.1, 0), Vec3(0.1, 0.1, 0)}, {}, {}};
  CHECK_THROWS_WITH_AS(find_leaflets(p.sheet, p.rims, c, far, findings),
                       doctest::Contains("LPS or RAS"), Error);
  far.commissures = {Vec3(17e-3, 4e-3, 0), Vec3(17e-3, 2e-3, 0)};
  CHECK_THROWS_WITH_AS(find_leaflets(p.sheet, p.rims, c, far, findings),
                       doctest::Contains("one point for each commissure"), Error);
}
