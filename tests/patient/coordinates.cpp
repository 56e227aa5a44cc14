// Coordinates on a sheet, beside the formulas of the parametric valve.
#include "patient/coordinates.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/about.h"
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
}  // namespace

TEST_CASE("lengths_around_a_loop_are_wrapped") {
  CHECK(wrapped(-0.25, 1) == 0.75);
  CHECK(wrapped(2.5, 1) == 0.5);
  CHECK(around(0.9, 0.1, 1) == about(0.2));
  CHECK(around(0.1, 0.9, 1) == about(-0.2));
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
    CHECK(anterior == about(25e-3, 0.03));
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
