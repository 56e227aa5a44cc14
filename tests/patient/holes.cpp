// Holes and missing rims of sheets.
#include "patient/findings.h"
#include "patient/normal_numbers.h"
#include "patient/surface/fill_hole.h"
#include "patient/surface/rims.h"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "base/error.h"
#include "geometry/intersect.h"
#include "model/sides.h"
#include "patient/surface/boundary.h"
#include "patient/surface/clean_surface.h"
#include "patient/surface/holes.h"
#include "patient/surface/manifold.h"
#include "patient/surface/weld.h"
#include "tests/about.h"
#include "tests/patient/cleaned.h"
#include "tests/patient/parametric_sheet.h"
#include "tests/patient/surfaces.h"

using namespace mvs::core;
using namespace mvs::core::test;

namespace {

double area_of(const LeafletSheet &sheet) {
  double area = 0;
  for (const Tri &t : sheet.triangles) area += triangle_area(sheet.x, t);
  return area;
}

}  // namespace

TEST_CASE("find_rims_fills_holes") {
  const ParametricSheet p = parametric_sheet(1600);
  const double area = area_of(p.sheet);
  const std::vector<uint8_t> rim = [&] {
    std::vector<uint8_t> marks = marks_of(p.rims.annulus, p.sheet.x.size());
    for (const uint32_t i : p.rims.free_edge) marks[i] = 1;
    return marks;
  }();
  // three vertices inside, and one hole of several stars
  std::vector<uint32_t> inside;
  for (uint32_t i = 0; i < p.sheet.x.size() && inside.size() < 3; i += 97) {
    bool far = true;
    for (uint32_t j = 0; j < p.sheet.x.size(); ++j) {
      if (rim[j] != 0) far = far && (p.sheet.x[i] - p.sheet.x[j]).norm() > 4e-3;
    }
    if (far) inside.push_back(i);
  }
  REQUIRE(inside.size() == 3);
  std::vector<uint32_t> removed = inside;
  for (uint32_t j = 0; j < p.sheet.x.size(); ++j) {
    if ((p.sheet.x[j] - p.sheet.x[inside[2]]).norm() < 2e-3) removed.push_back(j);
  }
  Findings findings;
  LeafletSheet sheet = cleaned(without_stars(surface_of(p.sheet), removed));
  sheet.thickness.assign(sheet.x.size(), 1.1e-3);
  sheet.label.assign(sheet.triangles.size(), LeafletLabel::posterior);
  const double open_area = area_of(sheet);
  const SheetRims rims = find_rims(sheet, {}, findings);
  CHECK(rims.annulus.size() == p.rims.annulus.size());
  const Finding *filled = find(findings, "filled_holes");
  REQUIRE(filled);
  CHECK(filled->value.size() == 3);
  // a chord of a curved patch: the hole is 6 mm across, the leaflet has a radius of 10 mm and more
  CHECK(area - open_area > 15e-6);
  CHECK(area_of(sheet) == about(area, 0.05 * (area - open_area) / area));
  CHECK(sheet.thickness.size() == sheet.x.size());
  CHECK(sheet.label.size() == sheet.triangles.size());
  for (const double t : sheet.thickness) CHECK(t == about(1.1e-3));
  for (const LeafletLabel l : sheet.label) CHECK(l == LeafletLabel::posterior);
  CHECK(boundary_loops(sheet).size() == 2);
  CHECK(join_sides(sheet.x, sheet.triangles).opened == 0);
  CHECK(wind_alike(sheet, join_sides(sheet.x, sheet.triangles).across) == 0);
  // the filling has sides like those around it
  const double side = std::sqrt(area / double(p.sheet.triangles.size()) * 4 / std::sqrt(3.0));
  for (const Tri &t : sheet.triangles) {
    for (size_t k = 0; k < 3; ++k) {
      CHECK((sheet.x[t[(k + 1) % 3]] - sheet.x[t[k]]).norm() < 2.5 * side);
    }
  }
}

TEST_CASE("find_rims_fills_a_hole_beside_a_triangle_that_is_folded_back") {
  // the triangulation of least area would put a second triangle on the folded one
  const Surface whole = funnel(32, 8);
  const uint32_t middle = 32 * 4 + 5, a = middle + 1, b = middle + 33;
  Surface s = without_stars(whole, {middle});
  const Vec3 half = 0.5 * (s.x[a] + s.x[b]);
  s.x.push_back(half + (half - s.x[middle]) + Vec3(0, 0, 0.2e-3));
  const Tri fold = {a, b, static_cast<uint32_t>(s.x.size() - 1)};
  const auto joins = [&](const Tri &t) {
    return std::find(t.begin(), t.end(), a) != t.end() &&
           std::find(t.begin(), t.end(), b) != t.end();
  };
  REQUIRE(std::count_if(s.triangles.begin(), s.triangles.end(), joins) == 1);
  s.triangles.push_back(fold);
  LeafletSheet sheet = cleaned(s);
  Findings findings;
  find_rims(sheet, {}, findings);
  CHECK(join_sides(sheet.x, sheet.triangles).opened == 0);
  CHECK(boundary_loops(sheet).size() == 2);
  CHECK(find(findings, "filled_holes")->value.size() == 1);
}

TEST_CASE("find_rims_keeps_a_torn_rim_as_one_boundary") {
  const ParametricSheet p = parametric_sheet(1600);
  std::vector<uint32_t> torn(p.rims.free_edge.begin() + 10, p.rims.free_edge.begin() + 16);
  torn.insert(torn.end(), p.rims.annulus.begin() + 20, p.rims.annulus.begin() + 23);
  LeafletSheet sheet = cleaned(without_stars(surface_of(p.sheet), torn));
  Findings findings;
  const SheetRims rims = find_rims(sheet, {}, findings);
  CHECK(boundary_loops(sheet).size() == 2);
  CHECK(rims.annulus.size() > p.rims.annulus.size() - 4);
  CHECK(shape_of(sheet, rims.annulus).length ==
        about(shape_of(p.sheet, p.rims.annulus).length, 0.1));
}

TEST_CASE("find_rims_refuses_surfaces_without_two_rims") {
  const Surface whole = funnel(48, 12);
  Findings findings;
  // a hole 1/6 of the way around is no small one
  std::vector<uint32_t> window;
  for (uint32_t j = 3; j < 9; ++j) {
    for (uint32_t i = 0; i < 10; ++i) window.push_back(48 * j + i);
  }
  CHECK_THROWS_WITH_AS(rims_of(without_stars(whole, window), {}, findings),
                       doctest::Contains("3 boundaries: 10"), Error);
  // a strip from rim to rim is missing
  std::vector<uint32_t> strip;
  for (uint32_t j = 0; j <= 12; ++j) strip.push_back(48 * j);
  CHECK_THROWS_WITH_AS(rims_of(without_stars(whole, strip), {}, findings),
                       doctest::Contains("one boundary"), Error);
  // both rims are closed by fans
  Surface closed = whole;
  closed.x.push_back({0, 0, 1e-3});
  closed.x.push_back({0, 0, -13e-3});
  for (uint32_t i = 0; i < 48; ++i) {
    const uint32_t j = (i + 1) % 48;
    closed.triangles.push_back({j, i, static_cast<uint32_t>(whole.x.size())});
    closed.triangles.push_back(
        {12 * 48 + i, 12 * 48 + j, static_cast<uint32_t>(whole.x.size() + 1)});
  }
  CHECK_THROWS_WITH_AS(rims_of(closed, {}, findings), doctest::Contains("give it as skin"), Error);
}

// A funnel without the vertices (i, row) for 12 columns i in a row, 1.2 mm high each, from a column
// on.
Surface with_slit(const Surface &whole, uint32_t row, uint32_t column) {
  std::vector<uint32_t> slit;
  for (uint32_t i = 0; i < 12; ++i) slit.push_back(48 * row + (column + i) % 48);
  return without_stars(whole, slit);
}

TEST_CASE("holes_one_triangle_from_the_free_edge_are_filled_as_a_guess") {
  const Surface whole = funnel(48, 12);
  // 2.4 mm high, 14 to 16 mm wide: longer around than a fifth of the annulus; one row below it is
  // left
  const Surface slit = with_slit(whole, 10, 5),
                both = with_slit(without_stars(slit, {48 * 5}), 10, 28);
  const LeafletSheet full = cleaned(whole);
  for (const size_t holes : {1u, 3u}) {
    Findings findings;
    LeafletSheet sheet = cleaned(holes == 1 ? slit : both);
    const double open_area = area_of(sheet), full_area = area_of(full);
    const SheetRims rims = find_rims(sheet, {}, findings);
    CHECK(rims.free_edge.size() == 48);
    CHECK(rims.annulus.size() == 48);
    CHECK(boundary_loops(sheet).size() == 2);
    CHECK(join_sides(sheet.x, sheet.triangles).opened == 0);
    CHECK(find_intersections(sheet.x, sheet.triangles).empty());
    // least area: the filling is a chord of a leaflet with a radius of 9 mm
    CHECK(area_of(sheet) - open_area > 0.85 * (full_area - open_area));
    const Finding *filled = find(findings, "filled_holes");
    REQUIRE(filled);
    CHECK(filled->value.size() == holes);
    CHECK(filled->value.back() > 0.2 * shape_of(full, rims.annulus).length);
    CHECK(filled->source == FindingSource::guessed);
    CHECK(filled->confidence == 0.5);
    CHECK(filled->sentence.find("cut the strand") != std::string::npos);
  }
  // far from the rims and short: surer
  Findings findings;
  rims_of(without_stars(whole, {48 * 5}), {}, findings);
  CHECK(find(findings, "filled_holes")->confidence == 0.9);
}

TEST_CASE("a_second_orifice_is_no_hole") {
  const Surface slit = with_slit(funnel(48, 12), 10, 5);
  Findings findings;
  // half of its rim has the label of the other leaflet
  LeafletSheet labelled = cleaned(slit);
  for (size_t t = 0; t < labelled.triangles.size(); ++t) {
    const Vec3 &p = labelled.x[labelled.triangles[t][0]];
    const double angle = std::atan2(p.y(), p.x()) / 6.283185307179586 * 48;
    labelled.label[t] =
        angle > 10.5 && angle < 34 ? LeafletLabel::anterior : LeafletLabel::posterior;
  }
  LeafletSheet one_label = labelled;
  CHECK_THROWS_WITH_AS(find_rims(labelled, {}, findings), doctest::Contains("3 boundaries"), Error);
  one_label.label.assign(one_label.triangles.size(), LeafletLabel::posterior);
  CHECK_NOTHROW(find_rims(one_label, {}, findings));
  // no labels, and tissue hangs down from its rim
  LeafletSheet sleeve = cleaned(slit);
  for (const std::vector<uint32_t> &loop : boundary_loops(sleeve)) {
    if (loop.size() > 40) continue;
    const uint32_t first = static_cast<uint32_t>(sleeve.x.size()),
                   n = static_cast<uint32_t>(loop.size());
    for (const uint32_t i : loop) {
      const Vec3 out(sleeve.x[i].x(), sleeve.x[i].y(), 0);
      sleeve.x.push_back(sleeve.x[i] + 2e-3 * out.normalized());
    }
    for (uint32_t k = 0; k < n; ++k) {
      const uint32_t m = (k + 1) % n;
      sleeve.triangles.push_back({loop[m], loop[k], first + k});
      sleeve.triangles.push_back({loop[m], first + k, first + m});
    }
    break;
  }
  sleeve.label.assign(sleeve.triangles.size(), LeafletLabel::unknown);
  CHECK_THROWS_WITH_AS(find_rims(sleeve, {}, findings),
                       doctest::Contains("less than 40 mm2 within one leaflet"), Error);
}

TEST_CASE("new_vertices_of_the_filling_of_a_crumpled_hole_keep_apart") {
  size_t made = 0;
  for (uint64_t seed = 0; seed < 40; ++seed) {
    // a rim as of shredded labels: a slit that goes back and forth
    NormalNumbers random(seed);
    const size_t n = 30 + seed;
    LeafletSheet sheet;
    std::vector<uint32_t> loop;
    const double length = 8e-3, width = 1e-3 * random.uniform(), noise = 0.5e-3;
    for (size_t k = 0; k < n; ++k) {
      const double angle = 2 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(n);
      loop.push_back(static_cast<uint32_t>(k));
      sheet.x.push_back(Vec3(length * std::cos(angle), width * std::sin(angle), 0) +
                        noise * Vec3(random.next(), random.next(), random.next()));
    }
    double sides = 0;
    for (size_t k = 0; k < n; ++k) sides += (sheet.x[(k + 1) % n] - sheet.x[k]).norm();
    fill_hole(sheet, loop);
    double least = 1;
    for (size_t i = n; i < sheet.x.size(); ++i) {
      for (size_t j = n; j < i; ++j) least = std::min(least, (sheet.x[i] - sheet.x[j]).norm());
    }
    made += sheet.x.size() - n;
    // those in the middle of one long side would be at the same place
    CAPTURE(seed);
    CHECK(least > 0.01 * sides / static_cast<double>(n));
  }
  CHECK(made > 100);
}

TEST_CASE("holes_filled_before_and_after_a_cut_are_one_finding") {
  constexpr uint32_t round = 60, down = 8;
  Surface s = funnel(round, down);
  LeafletSheet sheet = cleaned(s);
  FilledHoles filled;
  const auto open_and_fill = [&](uint32_t vertex) {
    std::vector<uint8_t> kept;
    for (const Tri &t : sheet.triangles) {
      kept.push_back(std::find(t.begin(), t.end(), vertex) == t.end());
    }
    keep_triangles(sheet, kept);
    std::vector<RimLoop> rims = sorted_rims(sheet);
    REQUIRE(rims.size() == 3);
    fill_holes(sheet, rims, filled);
    CHECK(rims.size() == 2);
  };
  open_and_fill(4 * round + 45);
  open_and_fill(3 * round + 10);
  Findings findings;
  report_holes(filled, findings);
  REQUIRE(findings.size() == 1);
  CHECK(findings[0].name == "filled_holes");
  CHECK(findings[0].value.size() == 2);
  CHECK(findings[0].sentence.starts_with("holes that were filled: 2, "));
}
