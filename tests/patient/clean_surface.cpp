// Cleaning of surfaces with known faults.
#include "patient/surface/clean_surface.h"

#include <doctest/doctest.h>

#include "base/error.h"
#include "model/sides.h"
#include "patient/surface/boundary.h"
#include "tests/about.h"
#include "tests/patient/cleaned.h"
#include "tests/patient/parametric_sheet.h"
#include "tests/patient/surfaces.h"
#include "tests/patient/voxel_skin.h"

using namespace mvs::core;
using namespace mvs::core::test;

namespace {

double area_of(const std::vector<Vec3> &x, const std::vector<Tri> &triangles) {
  double area = 0;
  for (const Tri &t : triangles) area += triangle_area(x, t);
  return area;
}

// Whether each side is passed once in each direction at most.
bool wound_alike(const std::vector<Tri> &triangles) {
  std::vector<Edge> directed;
  for (const Tri &t : triangles) {
    for (size_t k = 0; k < 3; ++k) directed.push_back({t[k], t[(k + 1) % 3]});
  }
  std::sort(directed.begin(), directed.end());
  return std::adjacent_find(directed.begin(), directed.end()) == directed.end();
}

void add_triangle(Surface &s, const Vec3 &a, const Vec3 &b, const Vec3 &c) {
  const uint32_t first = static_cast<uint32_t>(s.x.size());
  s.x.insert(s.x.end(), {a, b, c});
  s.triangles.push_back({first, first + 1, first + 2});
}

}  // namespace

TEST_CASE("clean_surface_keeps_a_sheet_without_faults_as_it_is") {
  const ParametricSheet p = parametric_sheet(430);
  Findings findings;
  const std::vector<double> thickness(p.sheet.x.size(), 1.2e-3);
  std::vector<LeafletLabel> label(p.sheet.triangles.size(), LeafletLabel::anterior);
  label[7] = LeafletLabel::posterior;
  const LeafletSheet sheet =
      clean_surface(p.sheet.x, p.sheet.triangles, label, thickness, findings);
  CHECK(sheet.x == p.sheet.x);
  CHECK(sheet.triangles == p.sheet.triangles);
  CHECK(sheet.label == label);
  CHECK(sheet.thickness == thickness);
  REQUIRE(findings.size() == 1);
  CHECK(findings[0].name == "surface");
  CHECK(findings[0].value[0] == area_of(p.sheet.x, p.sheet.triangles));
}

TEST_CASE("clean_surface_welds_soup_with_rounded_points_back_to_the_sheet") {
  const ParametricSheet p = parametric_sheet(430);
  Findings findings;
  const LeafletSheet sheet = cleaned(soup(surface_of(p.sheet)), findings);
  CHECK(sheet.x.size() == p.sheet.x.size());
  CHECK(sheet.triangles.size() == p.sheet.triangles.size());
  const Finding *welded = find(findings, "welded_points");
  REQUIRE(welded);
  CHECK(welded->value[0] == double(3 * p.sheet.triangles.size() - p.sheet.x.size()));
  // coordinates differ by the rounding of text with three digits, 0.5 um
  Surface rough = soup(surface_of(p.sheet));
  uint64_t seed = 5;
  for (Vec3 &x : rough.x) x += 0.5e-6 * Vec3{next_share(seed), next_share(seed), next_share(seed)};
  CHECK(cleaned(rough).x.size() == p.sheet.x.size());
}

TEST_CASE("clean_surface_does_not_depend_on_numbers_and_winding") {
  const ParametricSheet p = parametric_sheet(430);
  Findings findings;
  const LeafletSheet sheet =
      cleaned(flipped(renumbered(soup(surface_of(p.sheet)), 3), 3), findings);
  CHECK(sheet.x.size() == p.sheet.x.size());
  CHECK(wound_alike(sheet.triangles));
  CHECK(boundary_loops(sheet).size() == 2);
  const Finding *turned = find(findings, "turned_triangles");
  REQUIRE(turned);
  const size_t every_third = (p.sheet.triangles.size() + 2) / 3;
  CHECK(turned->value[0] == static_cast<double>(every_third));
}

TEST_CASE("clean_surface_drops_collapsed_double_and_flat_triangles") {
  Surface s = funnel(24, 6);
  const double area = area_of(s.x, s.triangles);
  const size_t count = s.triangles.size();
  s.triangles.push_back({3, 3, 4});
  s.triangles.push_back({s.triangles[10][2], s.triangles[10][1], s.triangles[10][0]});
  s.x.push_back(Vec3::Zero());  // in no triangle
  // a triangle with the middle of an edge as a corner
  const uint32_t middle = static_cast<uint32_t>(s.x.size());
  const Tri cut = s.triangles[40];
  s.x.push_back(0.5 * (s.x[cut[0]] + s.x[cut[2]]));
  s.triangles.push_back({cut[0], middle, cut[2]});
  s.triangles[40] = {cut[0], cut[1], middle};
  s.triangles.push_back({cut[1], cut[2], middle});
  Findings findings;
  const LeafletSheet sheet = cleaned(s, findings);
  CHECK(find(findings, "dropped_triangles")->value == std::vector<double>{1, 1});
  CHECK(find(findings, "unused_points")->value[0] == 1);
  CHECK(find(findings, "flat_triangles")->value[0] == 1);
  CHECK(sheet.triangles.size() == count + 2);
  CHECK(boundary_loops(sheet).size() == 2);
  // sums of some hundred terms
  CHECK(area_of(sheet.x, sheet.triangles) == about(area, 1e-12));
  double flattest = 1;
  for (const Tri &t : sheet.triangles) flattest = std::min(flattest, triangle_area(sheet.x, t));
  CHECK(flattest > 0.1 * area / double(count));
}

TEST_CASE("clean_surface_drops_small_pieces_and_refuses_large_ones") {
  Surface s = funnel(24, 6);
  const size_t count = s.triangles.size();
  add_triangle(s, {0, 0, 5e-3}, {1e-3, 0, 5e-3}, {0, 1e-3, 5e-3});
  Findings findings;
  const LeafletSheet sheet = cleaned(s, findings);
  CHECK(sheet.triangles.size() == count);
  CHECK(find(findings, "dropped_pieces")->value[0] == 1);
  CHECK(find(findings, "dropped_pieces")->value[1] == about(0.5e-6));
  add_triangle(s, {0, 0, 5e-3}, {1e-2, 0, 5e-3}, {0, 1e-2, 5e-3});
  CHECK_THROWS_WITH_AS(cleaned(s), doctest::Contains("2 pieces"), Error);
}

TEST_CASE("clean_surface_opens_edges_of_three_triangles_and_drops_the_fin") {
  Surface s = funnel(24, 6);
  const size_t count = s.triangles.size(), points = s.x.size();
  // a fin on an inner edge, 1 mm up from it
  const Tri t = s.triangles[100];
  s.x.push_back(0.5 * (s.x[t[0]] + s.x[t[1]]) + Vec3(0, 0, 1e-3));
  s.triangles.push_back({t[0], t[1], static_cast<uint32_t>(points)});
  Findings findings;
  const LeafletSheet sheet = cleaned(s, findings);
  CHECK(sheet.triangles.size() == count);
  CHECK(sheet.x.size() == points);
  REQUIRE(find(findings, "opened_edges"));
  CHECK(boundary_loops(sheet).size() == 2);
  // a fin as large as a leaflet
  s.x.back() += Vec3(0, 0, 0.1);
  CHECK_THROWS_WITH_AS(cleaned(s), doctest::Contains("more than two triangles meet"), Error);
}

TEST_CASE("clean_surface_takes_bodies_apart_that_touch_along_an_edge") {
  // two cubes; their faces at the common edge are in line, but of different bodies
  Surface s;
  const std::array<Tri, 12> faces = {{{0, 2, 1},
                                      {1, 2, 3},
                                      {4, 5, 6},
                                      {5, 7, 6},
                                      {0, 1, 4},
                                      {1, 5, 4},
                                      {2, 6, 3},
                                      {3, 6, 7},
                                      {0, 4, 2},
                                      {2, 4, 6},
                                      {1, 3, 5},
                                      {3, 7, 5}}};
  for (const double at : {0.0, 15e-3}) {
    const uint32_t first = static_cast<uint32_t>(s.x.size());
    for (uint32_t k = 0; k < 8; ++k) {
      s.x.push_back(Vec3(at + 15e-3 * (k & 1), at + 15e-3 * (k >> 1 & 1), 15e-3 * (k >> 2)));
    }
    for (const Tri &t : faces) s.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  }
  CHECK_THROWS_WITH_AS(cleaned(s),
                       doctest::Contains("2 pieces that are not connected, of 1350, 1350"), Error);
}

TEST_CASE("clean_surface_refuses_a_cloud_of_triangles_with_a_sentence_of_its_own") {
  // 400 triangles apart from each other: no piece has a share that counts
  Surface s;
  for (uint32_t k = 0; k < 400; ++k) {
    const uint32_t row = k / 20, column = k % 20;
    const Vec3 at(50e-3 * column, 50e-3 * row, 0);
    add_triangle(s, at, at + Vec3(30e-3, 0, 0), at + Vec3(0, 30e-3, 0));
  }
  CHECK_THROWS_WITH_AS(cleaned(s), doctest::Contains("a cloud of 400 pieces"), Error);
}

TEST_CASE("clean_surface_splits_an_edge_of_a_body_that_touches_itself") {
  // two plates, joined by two blocks between them that touch along an edge: both ends of the edge
  // are on one fan of triangles each
  const Surface s = cell_surface(Vec3::Zero(), 7e-3, {4, 4, 5}, [](const Cell &c) {
    const bool in = c[0] >= 1 && c[0] <= 2 && c[1] >= 1 && c[1] <= 2 && c[2] >= 1 && c[2] <= 3;
    return in && (c[2] != 2 || c[0] == c[1]);
  });
  Findings findings;
  const LeafletSheet sheet = cleaned(s, findings);
  CHECK(find(findings, "opened_edges"));
  CHECK(find(findings, "separated_points")->value[0] == 2);
  CHECK(wound_alike(sheet.triangles));
  CHECK(boundary_loops(sheet).empty());
  CHECK(area_of(sheet.x, sheet.triangles) == about(area_of(s.x, s.triangles)));
}

TEST_CASE("clean_surface_separates_parts_that_touch_in_a_point") {
  Surface s = funnel(24, 6);
  const size_t points = s.x.size();
  // vertices of the free edge on opposite sides become one
  const uint32_t a = 6 * 24, b = 6 * 24 + 12;
  for (Tri &t : s.triangles) {
    for (uint32_t &i : t) i = i == b ? a : i;
  }
  Findings findings;
  const LeafletSheet sheet = cleaned(s, findings);
  CHECK(sheet.x.size() == points);
  REQUIRE(find(findings, "separated_points"));
  CHECK(find(findings, "separated_points")->value[0] == 1);
  CHECK(boundary_loops(sheet).size() == 2);
}

TEST_CASE("clean_surface_refuses_a_surface_with_one_side") {
  Surface s;
  const uint32_t n = 40;
  for (uint32_t i = 0; i < n; ++i) {
    const double angle = 2 * 3.14159265358979 * i / n, half = 0.5 * angle;
    const Vec3 out(std::cos(angle), std::sin(angle), 0);
    const Vec3 across = std::cos(half) * out + Vec3(0, 0, std::sin(half));
    s.x.push_back(15e-3 * out - 4e-3 * across);
    s.x.push_back(15e-3 * out + 4e-3 * across);
  }
  for (uint32_t i = 0; i < n; ++i) {
    const uint32_t a = 2 * i, b = 2 * i + 1;
    const uint32_t c = i + 1 < n ? a + 2 : 1, d = i + 1 < n ? a + 3 : 0;
    s.triangles.push_back({a, c, d});
    s.triangles.push_back({a, d, b});
  }
  CHECK_THROWS_WITH_AS(cleaned(s), doctest::Contains("one side only"), Error);
}

TEST_CASE("clean_surface_names_the_unit_of_surfaces_that_are_not_in_metres") {
  const auto scaled = [](double factor) {
    Surface s = funnel(24, 6);
    for (Vec3 &x : s.x) x *= factor;
    return s;
  };
  CHECK_THROWS_WITH_AS(
      cleaned(scaled(1e3)),
      "this surface is 32 m wide: its lengths seem to be in mm; divide by 1000 or give --unit mm",
      Error);
  CHECK_THROWS_WITH_AS(cleaned(scaled(1e2)), doctest::Contains("give --unit cm"), Error);
  // read as mm: the widths are those of a valve in m and in cm
  CHECK_THROWS_WITH_AS(cleaned(scaled(1e-3)), doctest::Contains("give --unit m"), Error);
  CHECK_THROWS_WITH_AS(cleaned(scaled(1e-1)), doctest::Contains("give --unit cm"), Error);
  // mm read as cm
  CHECK_THROWS_WITH_AS(cleaned(scaled(10)), doctest::Contains("give --unit mm"), Error);
  CHECK_THROWS_WITH_AS(cleaned(scaled(1e4)), doctest::Contains("10 to 150 mm wide"), Error);
}

TEST_CASE("clean_surface_refuses_arrays_that_do_not_fit") {
  const Surface s = funnel(24, 6);
  Findings findings;
  const auto refused = [&](const Surface &bad, const char *sentence) {
    CHECK_THROWS_WITH_AS(cleaned(bad), doctest::Contains(sentence), Error);
  };
  Surface bad = s;
  bad.triangles.clear();
  refused(bad, "no triangles");
  bad = s;
  bad.x[3].y() = NAN;
  refused(bad, "point 3 of points is");
  bad = s;
  bad.triangles[5][1] = 10000;
  refused(bad, "count points from 0");
  bad = s;
  for (Tri &t : bad.triangles) t = {0, 0, 1};
  refused(bad, "without area");
  CHECK_THROWS_WITH_AS(clean_surface(s.x, s.triangles, {LeafletLabel::anterior}, {}, findings),
                       doctest::Contains("1 labels for 288 triangles"), Error);
  CHECK_THROWS_WITH_AS(
      clean_surface(s.x, s.triangles, {}, std::vector<double>(s.x.size(), 1.5), findings),
      doctest::Contains("divide by 1000"), Error);
  CHECK_THROWS_WITH_AS(
      clean_surface(s.x, s.triangles, {}, std::vector<double>(s.x.size(), 0.9e-6), findings),
      doctest::Contains("multiply by 1000"), Error);
}

TEST_CASE("clean_surface_welds_a_real_valve_by_ultrasound") {
  const Surface s = real_stl("real_mitral/open_1146.stl");
  if (s.x.empty()) {
    MESSAGE("skipped: no real_mitral/open_1146.stl in MVS_TEST_DATA or ../shared/data");
    return;
  }
  Findings findings;
  const LeafletSheet sheet = cleaned(s, findings);
  CHECK(sheet.x.size() == 1146);
  CHECK(sheet.triangles.size() == 2146);
  const std::vector<std::vector<uint32_t>> loops = boundary_loops(sheet);
  REQUIRE(loops.size() == 2);
  CHECK(loops[0].size() + loops[1].size() == 146);
  CHECK(std::max(loops[0].size(), loops[1].size()) == 79);
}
