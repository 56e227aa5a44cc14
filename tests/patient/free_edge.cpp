// Notches of torn free edges.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "base/math.h"
#include "geometry/intersect.h"
#include "model/sides.h"
#include "patient/surface/boundary.h"
#include "patient/surface/mend_free_edge.h"
#include "tests/about.h"

using namespace mvs::core;
using mvs::core::test::about;

namespace {

// A flat band of squares of 1 mm between a rim at y = 0 and a free edge at y = 10 mm, around a
// cylinder of a large radius; without the cells at the edge for which `gone(i, row)` is true.
template <typename Gone>
LeafletSheet band(uint32_t round, Gone gone) {
  LeafletSheet sheet;
  const double radius = 1e-3 * round / 6.283185307179586;
  for (uint32_t j = 0; j <= 10; ++j) {
    for (uint32_t i = 0; i < round; ++i) {
      const double angle = 6.283185307179586 * i / round;
      sheet.x.push_back({radius * std::cos(angle), radius * std::sin(angle), -1e-3 * j});
    }
  }
  for (uint32_t j = 0; j < 10; ++j) {
    for (uint32_t i = 0; i < round; ++i) {
      if (gone(i, 9 - j)) continue;
      const uint32_t a = j * round + i, b = j * round + (i + 1) % round;
      sheet.triangles.push_back({a, a + round, b + round});
      sheet.triangles.push_back({a, b + round, b});
    }
  }
  sheet.label.assign(sheet.triangles.size(), LeafletLabel::posterior);
  return sheet;
}

SheetRims rims_of(const LeafletSheet &sheet) {
  SheetRims rims;
  for (std::vector<uint32_t> &loop : boundary_loops(sheet)) {
    (sheet.x[loop[0]].z() > -1e-6 ? rims.annulus : rims.free_edge) = std::move(loop);
  }
  return rims;
}

}  // namespace

TEST_CASE("notches_are_filled_and_clefts_and_straight_edges_are_kept") {
  constexpr uint32_t round = 80;
  const LeafletSheet whole = band(round, [](uint32_t, uint32_t) { return false; });
  const double full = surface_area(whole.x, whole.triangles);
  LeafletSheet sheet = whole;
  SheetRims rims = rims_of(sheet);
  CHECK(fill_notches(sheet, rims.free_edge, std::vector<uint8_t>(sheet.x.size(), 0)).last.empty());
  CHECK(sheet.triangles == whole.triangles);

  // three notches, 1 to 3 mm wide and deep, and a cleft 1 mm wide and 7 mm deep
  sheet = band(round, [](uint32_t i, uint32_t row) {
    return (i == 5 && row < 1) || (i >= 20 && i < 22 && row < 2) ||
           (i >= 40 && i < 43 && row < 3) || (i == 60 && row < 7);
  });
  rims = rims_of(sheet);
  const size_t edge_before = rims.free_edge.size();
  const FilledNotches filled =
      fill_notches(sheet, rims.free_edge, std::vector<uint8_t>(sheet.x.size(), 0));
  CHECK(filled.last.size() == 3);
  CHECK(filled.deepest == about(3e-3, 0.02));
  // mouths of 2 and 3 mm are divided into sides of 1 mm
  CHECK(rims.free_edge.size() == edge_before - 2 - (5 - 1) - (8 - 2));
  // the band is whole again but for the cleft, up to the sagitta of chords of 3 mm
  CHECK(surface_area(sheet.x, sheet.triangles) == about(full - 7e-6, 2e-3));
  CHECK(find_intersections(sheet.x, sheet.triangles).empty());
  CHECK(boundary_loops(sheet).size() == 2);
  CHECK(sheet.label.size() == sheet.triangles.size());

  // marked vertices stay on the edge
  sheet = band(round, [](uint32_t i, uint32_t row) { return i == 5 && row < 1; });
  rims = rims_of(sheet);
  const std::vector<uint32_t> edge = rims.free_edge;
  fill_notches(sheet, rims.free_edge, std::vector<uint8_t>(sheet.x.size(), 1));
  CHECK(rims.free_edge == edge);
}

TEST_CASE("a_valley_of_the_edge_that_is_wider_than_a_notch_is_kept") {
  // V-shaped, 8 mm deep with sides at 30 degrees to its middle, as at a commissure: a straight line
  // over it has 1.5 of its length along the edge, and where it is 4 mm deep it is no wider than a
  // notch
  constexpr uint32_t round = 80, bottom = 30;
  LeafletSheet valley = band(round, [](uint32_t, uint32_t) { return false; });
  const double angle_of_step = 6.283185307179586 / round;
  for (Vec3 &x : valley.x) {
    double off = math::atan2(x.y(), x.x()) / angle_of_step - bottom;
    off = std::abs(off - round * std::round(off / round));
    const double depth = std::max(0.0, 8e-3 - 1e-3 * off / 0.5773502691896258);
    x.z() *= (10e-3 - depth) / 10e-3;
  }
  LeafletSheet sheet = valley;
  SheetRims rims = rims_of(sheet);
  CHECK(fill_notches(sheet, rims.free_edge, std::vector<uint8_t>(sheet.x.size(), 0)).last.empty());
  CHECK(sheet.triangles == valley.triangles);
}

TEST_CASE("the_valley_of_a_commissure_is_kept_where_the_edge_is_torn") {
  // V-shaped, 6 mm deep with sides at 45 degrees: 1.4 of its length along the edge, which is a
  // gentle notch beside three sharp ones; and narrower than the valley of the test above
  constexpr uint32_t round = 80, bottom = 30;
  const auto torn = [](uint32_t i, uint32_t row) {
    return (i == 5 && row < 1) || (i >= 50 && i < 52 && row < 2) || (i >= 65 && i < 68 && row < 3);
  };
  LeafletSheet sheet = band(round, torn);
  const double angle_of_step = 6.283185307179586 / round;
  for (Vec3 &x : sheet.x) {
    double off = math::atan2(x.y(), x.x()) / angle_of_step - bottom;
    off = std::abs(off - round * std::round(off / round));
    x.z() *= (10e-3 - std::max(0.0, 6e-3 - 1e-3 * off)) / 10e-3;
  }
  SheetRims rims = rims_of(sheet);
  const double before = surface_area(sheet.x, sheet.triangles);
  const FilledNotches filled =
      fill_notches(sheet, rims.free_edge, std::vector<uint8_t>(sheet.x.size(), 0));
  CHECK(filled.last.size() == 3);
  CHECK(filled.area == about(14e-6, 0.05));  // of the notches alone
  CHECK(surface_area(sheet.x, sheet.triangles) == about(before + filled.area));
  for (uint32_t i = bottom - 6; i <= bottom + 6; ++i) {
    const uint32_t at = 10 * round + i;
    CHECK(std::count(rims.free_edge.begin(), rims.free_edge.end(), at) == 1);
  }
}

TEST_CASE("notches_whose_filling_crosses_are_marked") {
  FilledNotches notches;
  notches.sheet_triangles = 10;
  notches.last = {12, 15};
  notches.inner = {{1, 2}, {3}};
  std::vector<uint8_t> kept(5, 0);
  CHECK(keep_crossing(notches, {{4, 13}}, kept));
  CHECK(kept == std::vector<uint8_t>{0, 0, 0, 1, 0});
  CHECK(!keep_crossing(notches, {{4, 13}}, kept));
  CHECK(keep_crossing(notches, {{4, 5}}, kept));  // not by a filling: all are kept
  CHECK(kept == std::vector<uint8_t>{0, 1, 1, 1, 0});
}
