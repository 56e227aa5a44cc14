// Leaflets that are too tall, and those that are not: fused beside the commissures, or thick.
#include "patient/tall_leaflets.h"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "base/error.h"
#include "patient/findings.h"
#include "tests/patient/sheets.h"

using namespace mvs::core;
using namespace mvs::core::test;

namespace {

constexpr double mm = 1e-3, length = 115 * mm;

// m along the annulus: the anterior leaflet between two commissures.
constexpr double from = 15 * mm, to = 57 * mm;

// A band around the z axis whose annulus lies at z = 0, as high as height(foot).
template <typename Height>
SheetWithRims band(Height height, double thickness) {
  constexpr uint32_t round = 115, rows = 20;
  constexpr double radius = length / (2 * std::numbers::pi);
  SheetWithRims made;
  for (uint32_t j = 0; j <= rows; ++j) {
    for (uint32_t i = 0; i < round; ++i) {
      const double angle = 2 * std::numbers::pi * i / round;
      made.sheet.x.emplace_back(radius * std::cos(angle), radius * std::sin(angle),
                                -height(length * i / round) * j / rows);
      if (j == rows) continue;
      const uint32_t a = j * round + i, b = j * round + (i + 1) % round;
      made.sheet.triangles.push_back({a, a + round, b + round});
      made.sheet.triangles.push_back({a, b + round, b});
    }
  }
  if (thickness > 0) made.sheet.thickness.assign(made.sheet.x.size(), thickness);
  for (uint32_t i = 0; i < round; ++i) {
    made.rims.annulus.push_back(i);
    made.rims.free_edge.push_back(rows * round + i);
  }
  return made;
}

// 10 mm at the commissures, `fused` more within 4 mm of them, and `wall` more all around.
double height_at(double foot, double fused, double wall) {
  const bool anterior = foot > from && foot < to;
  const double share = anterior
                           ? (foot - from) / (to - from)
                           : (foot < from ? foot - to + length : foot - to) / (length - to + from);
  const double beside = std::min(std::abs(foot - from), std::abs(foot - to));
  return 10 * mm + (anterior ? 13 : 4) * mm * std::sin(std::numbers::pi * share) +
         (beside < 4 * mm ? fused : 0) + wall;
}

bool is_tall(double fused, double wall, double thickness,
             const std::vector<Vec3> &commissures = {}) {
  const SheetWithRims made =
      band([&](double foot) { return height_at(foot, fused, wall); }, thickness);
  const SheetCoordinates coordinates = sheet_coordinates(made.sheet, made.rims);
  Findings findings{{"annulus", FindingSource::guessed, 0.8, "", {}, "m"}};
  doubt_tall_leaflets(made.sheet, made.rims, coordinates, {from, to}, commissures, findings);
  return find_finding(findings, "tall_leaflets") != nullptr;
}

// Points of the surface at both commissures, this far below its rim.
std::vector<Vec3> commissures_at(double below) {
  std::vector<Vec3> points;
  for (const double foot : {from, to}) {
    const double angle = 2 * std::numbers::pi * foot / length;
    const double radius = length / (2 * std::numbers::pi);
    points.emplace_back(radius * std::cos(angle), radius * std::sin(angle), -below);
  }
  return points;
}

}  // namespace

// Labels of leaflets that touch beside a commissure, and those of thick leaflets, were taken for
// leaflets with wall of the atrium.
TEST_CASE("leaflets_that_are_fused_beside_the_commissures_are_not_tall") {
  CHECK_FALSE(is_tall(0, 0, 0));
  CHECK_FALSE(is_tall(5 * mm, 0, 0));
  CHECK_FALSE(is_tall(5 * mm, 0, 2.4 * mm));
  // wall all around, with and without
  CHECK(is_tall(0, 5 * mm, 0));
  CHECK(is_tall(5 * mm, 5 * mm, 0));
}

TEST_CASE("thick_leaflets_are_taller_by_what_is_fused") {
  CHECK_FALSE(is_tall(0, 4 * mm, 2.4 * mm));
  CHECK(is_tall(0, 4 * mm, 0.8 * mm));
  CHECK(is_tall(0, 7 * mm, 2.4 * mm));
}

// 3 mm of wall do not make leaflets tall; landmarks show it.
TEST_CASE("given_commissures_below_the_annulus_show_wall") {
  CHECK_FALSE(is_tall(0, 2.5 * mm, 0));
  CHECK(is_tall(0, 2.5 * mm, 0, commissures_at(3.5 * mm)));
  // on the annulus, and where free edges meet
  CHECK_FALSE(is_tall(0, 2.5 * mm, 0, commissures_at(1.5 * mm)));
  CHECK_FALSE(is_tall(0, 0, 0, commissures_at(9 * mm)));
}

// The labels of a wall that is one with the posterior leaflet reach around the anterior one. "Give
// one point for each commissure" was said of commissures that were not given.
TEST_CASE("wall_that_is_labelled_as_a_leaflet_is_named_where_labels_give_no_commissures") {
  SheetWithRims made = band([](double foot) { return height_at(foot, 0, 5 * mm); }, 0);
  const SheetCoordinates coordinates = sheet_coordinates(made.sheet, made.rims);
  for (const Tri &t : made.sheet.triangles) {
    const double foot = triangle_foot(coordinates, t);
    made.sheet.label.push_back(foot > 30 * mm && foot < 48 * mm ? LeafletLabel::anterior
                                                                : LeafletLabel::posterior);
  }
  Findings findings;
  CHECK_THROWS_WITH_AS(find_leaflets(made.sheet, made.rims, coordinates, {}, findings),
                       doctest::Contains("is wall of the atrium labelled as a leaflet?"), Error);
  // of given ones, at one place
  const std::vector<Vec3> near = {made.sheet.x[30], made.sheet.x[48]};
  CHECK_THROWS_WITH_AS(find_leaflets(made.sheet, made.rims, coordinates, {near, {}, {}}, findings),
                       doctest::Contains("give one point for each commissure"), Error);
}
