// Commissures and scallops of a sheet, guessed, measured from labels or given, beside those of the
// parametric valve.
#include "patient/leaflets.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "base/error.h"
#include "measure/annulus/landmarks.h"
#include "model/sides.h"
#include "patient/coordinates.h"
#include "patient/doubtful.h"
#include "patient/findings.h"
#include "patient/leaflet_heights.h"
#include "patient/surface/mirrored.h"
#include "tests/about.h"
#include "tests/patient/sheets.h"

using namespace mvs::core;
using namespace mvs::core::test;
using std::numbers::pi;

namespace {

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
  const LeafletLandmarks landmarks = {points_in(first[0]), {points_in(first[1])[0]}, {}};
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
    CHECK(said.confidence == about(std::min(1.0, 3e-3 / above), 0.02));
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

TEST_CASE("commissures_beside_the_likeliest_places_are_doubted") {
  const ParametricSheet p = parametric_sheet(430);
  const SheetCoordinates c = sheet_coordinates(p.sheet, p.rims);
  Findings guessed;
  const LeafletArcs arcs = find_leaflets(p.sheet, p.rims, c, {}, guessed);
  const Loop annulus(p.rims.annulus, p.sheet.x);
  // landmarks by hand are up to 3 mm off; both turned the same way, and one alone
  for (const double off : {0.0, 3e-3, 12e-3}) {
    for (const double other : {off, 0.0}) {
      CAPTURE(off);
      CAPTURE(other);
      const std::vector<Vec3> points = {annulus.at(std::fmod(arcs.from + off, c.annulus_length)),
                                        annulus.at(std::fmod(arcs.to + other, c.annulus_length))};
      Findings found;
      find_leaflets(p.sheet, p.rims, c, {points, {}, {}}, found);
      const Finding &said = *find_finding(found, "commissures");
      CHECK((said.confidence < 0.1) == (off > 3e-3));
      CHECK((said.confidence == 1) == (off <= 3e-3));
      CHECK((said.sentence.find("from the likeliest places") != std::string::npos) == (off > 3e-3));
    }
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

TEST_CASE("a_given_anterior_leaflet_that_is_far_lower_or_fits_mirrored_is_doubted") {
  ParametricSheet p = parametric_sheet(430);
  for (Vec3 &x : p.sheet.x) x += Vec3(2e-3, 1.5e-3, 0);
  const SheetCoordinates c = sheet_coordinates(p.sheet, p.rims);
  Findings guessed, posterior, turned;
  find_leaflets(p.sheet, p.rims, c, {}, guessed);
  const Vec3 anterior = points_in(*find_finding(guessed, "anterior"))[0];
  const std::vector<Vec3> ends = points_in(*find_finding(guessed, "commissures"));
  Vec3 other = Vec3::Zero();
  for (const uint32_t i : p.rims.annulus) {
    if ((p.sheet.x[i] - anterior).norm() > (other - anterior).norm()) other = p.sheet.x[i];
  }
  find_leaflets(p.sheet, p.rims, c, {ends, {other}, {}}, posterior);
  const Finding &low = *find_finding(posterior, "anterior");
  CHECK(low.confidence <= 0.4);
  CHECK(low.sentence.find("are both leaflets swapped") != std::string::npos);
  find_leaflets(p.sheet, p.rims, c, {ends, {mirrored(anterior)}, {}}, turned);
  const Finding &off = *find_finding(turned, "anterior");
  CHECK(off.confidence <= 0.1);
  CHECK(off.sentence.find("in the other frame") != std::string::npos);
  Findings right;
  find_leaflets(p.sheet, p.rims, c, {ends, {anterior}, {}}, right);
  CHECK(find_finding(right, "anterior")->confidence == 1);
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

// Leaflets of 22 and 13 mm that meet at a height of 7 mm. A dip of 6 mm in the middle of the lower
// one makes two leaflets of it.
TEST_CASE("a_third_leaflet_makes_the_guess_doubtful") {
  constexpr size_t rows = 13, around = 96;
  for (const double dip : {0.0, 6e-3}) {
    SheetWithRims cone = revolved(std::vector<std::array<double, 2>>(rows + 1), around);
    for (size_t k = 0; k < cone.sheet.x.size(); ++k) {
      const double angle = 2 * pi * static_cast<double>(k % around) / around - pi / 2;
      const double off = std::abs(angle > pi ? angle - 2 * pi : angle), half = 0.36 * pi;
      const double u = off < half ? off / half : (pi - off) / (pi - half);
      const double bulge = 1 - u * u, notch = dip * std::exp(-16 * u * u);
      const double height = 7e-3 + (off < half ? 15e-3 * bulge : 6e-3 * bulge - notch);
      const size_t row = k / around;
      const double down = static_cast<double>(row) / rows, inward = 1 - 20 * height * down;
      const double y = 14e-3 * std::cos(angle);
      cone.sheet.x[k] = {-18e-3 * std::sin(angle) * inward, (y > 0 ? 0.75 * y : y) * inward,
                         -height * down};
    }
    const SheetCoordinates c = sheet_coordinates(cone.sheet, cone.rims);
    Findings findings;
    find_leaflets(cone.sheet, cone.rims, c, {}, findings);
    CHECK(is_doubtful(findings[0]) == (dip > 0));
    CHECK((findings[0].sentence.find("other places") != std::string::npos) == (dip > 0));
  }
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
  CHECK(findings[0].confidence == about(0.9, 0.03));
  const Loop annulus(p.rims.annulus, p.sheet.x);
  // the border of the labels is at x = +-17.5 mm, y of 4 mm; half a sample is 0.4 mm, a triangle 1
  // mm
  for (const double s : {arcs.from, arcs.to}) {
    CHECK(std::abs(annulus.at(s).x()) == about(17.5e-3, 0.1));
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
