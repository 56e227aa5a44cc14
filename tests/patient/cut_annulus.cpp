// Wall of the atrium cut off leaflets along points of the annulus.
#include "patient/surface/cut_annulus.h"

#include <doctest/doctest.h>
#include <cmath>

#include "base/error.h"
#include "geometry/intersect.h"
#include "patient/build_valve.h"
#include "patient/findings.h"
#include "patient/surface/annulus_through.h"
#include "patient/surface/boundary.h"
#include "patient/surface/level_cut.h"
#include "patient/tall_leaflets.h"
#include "tests/about.h"
#include "tests/patient/atrial_wall.h"

using namespace mvs::core;
using namespace mvs::core::test;

namespace {

constexpr double pi = 3.14159265358979;

// The largest distance of points from a closed polygon.
double farthest_from(const std::vector<Vec3> &points, const std::vector<Vec3> &loop) {
  double most2 = 0;
  for (const Vec3 &p : points) {
    double least2 = INFINITY;
    for (size_t k = 0; k < loop.size(); ++k) {
      const SegmentPoint at = closest_on_segment(p, loop[k], loop[(k + 1) % loop.size()]);
      least2 = std::min(least2, at.distance2);
    }
    most2 = std::max(most2, least2);
  }
  return std::sqrt(most2);
}

std::vector<Vec3> points_of(const LeafletSheet &sheet, const std::vector<uint32_t> &loop) {
  std::vector<Vec3> points;
  points.reserve(loop.size());
  for (const uint32_t i : loop) points.push_back(sheet.x[i]);
  return points;
}

struct CutLeaflets {
  LeafletSheet sheet;
  SheetRims rims;
  Findings findings;
};
CutLeaflets cut(const Surface &surface, const std::vector<Vec3> &points,
                const std::vector<Vec3> &tips = {}) {
  CutLeaflets made;
  made.sheet = cleaned(surface);
  made.rims = find_rims(made.sheet, {points, tips}, made.findings);
  return made;
}

// The leaflets alone are left: their area within 2 %, their annulus within half an edge both ways.
void check_leaflets(const CutLeaflets &found, const WalledValve &truth) {
  CHECK(sheet_area(found.sheet) == about(sheet_area(truth.leaflets), 0.02));
  const double half_edge = 0.5 * mean_edge(found.sheet);
  const std::vector<Vec3> annulus = points_of(found.sheet, found.rims.annulus);
  CHECK(farthest_from(annulus, truth.annulus) < half_edge);
  CHECK(farthest_from(truth.annulus, annulus) < half_edge);
  CHECK(boundary_loops(found.sheet).size() == 2);
  CHECK(find_intersections(found.sheet.x, found.sheet.triangles).empty());
  REQUIRE(find(found.findings, "atrial_tissue"));
  CHECK(find(found.findings, "annulus")->confidence > 0.5);
}

bool is_everywhere(uint32_t) {
  return true;
}

}  // namespace

TEST_CASE("wall_of_the_atrium_is_cut_off_along_annulus_points") {
  for (const double edge : {0.8e-3, 1.3e-3, 2e-3}) {
    const WalledValve valve = remeshed_with_wall(1600, 5, edge);
    CAPTURE(edge);
    const double whole = sheet_area(cleaned(valve.surface));
    CHECK(whole > 1.4 * sheet_area(valve.leaflets));  // the wall is no small part
    const CutLeaflets found = cut(valve.surface, annulus_points(valve, 6, 0));
    check_leaflets(found, valve);
    const Finding *wall = find(found.findings, "atrial_tissue");
    CHECK(wall->value[0] + sheet_area(found.sheet) == about(whole));
    // wherever it lies, and however it is wound
    const Surface other = flipped(moved(renumbered(valve.surface, 3), 1.2), 1);
    const WalledValve there = {{}, valve.leaflets, moved({valve.annulus, {}}, 1.2).x};
    CutLeaflets again = cut(other, annulus_points(there, 6, 0));
    check_leaflets(again, there);
  }
}

TEST_CASE("points_by_hand_cut_within_their_error") {
  // 1 mm in each direction, 24 points; the annulus is that of the points
  const WalledValve valve = remeshed_with_wall(1600, 5, 1.3e-3);
  const CutLeaflets found = cut(valve.surface, annulus_points(valve, 5, 1e-3));
  const std::vector<Vec3> annulus = points_of(found.sheet, found.rims.annulus);
  CHECK(farthest_from(annulus, valve.annulus) < 2e-3);
  CHECK(sheet_area(found.sheet) == about(sheet_area(valve.leaflets), 0.05));
  CHECK(boundary_loops(found.sheet).size() == 2);
}

TEST_CASE("a_wall_beside_a_part_of_the_annulus_is_cut_off") {
  // high walls, whose rims are less like an annulus than the free edge; narrow ones, whose rims lie
  // on the curve for the most part
  struct Wall {
    uint32_t rows, from, to;  // nodes of the annulus
  };
  for (const Wall &wall : {Wall{5, 30, 70}, Wall{6, 5, 65}, Wall{4, 10, 40}}) {
    CAPTURE(wall.from);
    const WalledValve valve =
        with_wall(1600, wall.rows, [&](uint32_t k) { return k > wall.from && k < wall.to; });
    REQUIRE(valve.annulus.size() > 80);
    check_leaflets(cut(valve.surface, annulus_points(valve, 6, 0)), valve);
  }
}

// The wall's rim spans 2.7 times the area of the free edge. Where it ends in waves it is less like
// an annulus than that edge, and the leaflets were cut off in place of the wall.
TEST_CASE("a_wall_that_ends_in_waves_is_cut_off") {
  WalledValve valve = with_wall(1600, 5, is_everywhere);
  const size_t n = valve.annulus.size(), first = valve.surface.x.size() - 5 * n;
  for (size_t i = 0; i < 5 * n; ++i) {
    const double angle = 2 * pi * static_cast<double>(i % n) / static_cast<double>(n);
    const double height = 0.65 + 0.35 * std::cos(12 * angle);
    double &z = valve.surface.x[first + i].z();
    z = valve.annulus[i % n].z() + height * (z - valve.annulus[i % n].z());
  }
  check_leaflets(cut(valve.surface, annulus_points(valve, 6, 0)), valve);
}

TEST_CASE("a_wall_with_veins_and_a_closed_atrium_are_cut_off") {
  WalledValve valve = with_wall(1600, 6, is_everywhere);
  const Surface open = valve.surface;
  const uint32_t n = static_cast<uint32_t>(valve.annulus.size());
  const uint32_t wall = static_cast<uint32_t>(valve.leaflets.x.size());
  // a vein: 14 columns, 3 rows
  std::erase_if(valve.surface.triangles, [&](const Tri &t) {
    return std::all_of(t.begin(), t.end(), [&](uint32_t i) {
      return i >= wall && (i - wall) / n >= 1 && (i - wall) / n <= 4 && (i - wall) % n < 15;
    });
  });
  CHECK(boundary_loops(cleaned(valve.surface)).size() == 3);
  check_leaflets(cut(valve.surface, annulus_points(valve, 6, 0)), valve);
  // a roof: one boundary, the free edge
  valve.surface = open;
  const uint32_t top = static_cast<uint32_t>(valve.surface.x.size()), last = top - n;
  valve.surface.x.emplace_back(0, 0, 30e-3);
  for (uint32_t k = 0; k < n; ++k) {
    valve.surface.triangles.push_back({last + (k + 1) % n, last + k, top});
  }
  CHECK(boundary_loops(cleaned(valve.surface)).size() == 1);
  check_leaflets(cut(valve.surface, annulus_points(valve, 6, 0)), valve);
}

TEST_CASE("a_wall_without_annulus_points_is_doubted_as_tall_leaflets") {
  const auto doubted = [](const WalledValve &valve, const std::vector<Vec3> &annulus) {
    LeafletSheet sheet = cleaned(valve.surface);
    Findings findings;
    const SheetRims rims = find_rims(sheet, {annulus, {}}, findings);
    const SheetCoordinates coordinates = sheet_coordinates(sheet, rims);
    const double before = find(findings, "annulus")->confidence;
    const LeafletArcs arcs = find_leaflets(sheet, rims, coordinates, {}, findings);
    doubt_tall_leaflets(sheet, rims, coordinates, arcs, {}, findings);
    const bool is_tall = find(findings, "tall_leaflets") != nullptr;
    CHECK(find(findings, "annulus")->confidence == (is_tall ? 0.5 * before : before));
    return is_tall;
  };
  // 6 mm all around, and none; the points cut the wall off
  const WalledValve wall = with_wall(430, 3, [](uint32_t) { return true; });
  CHECK(doubted(wall, {}));
  CHECK_FALSE(doubted(wall, wall.annulus));
  CHECK_FALSE(doubted(with_wall(430, 0, [](uint32_t) { return true; }), {}));
}

TEST_CASE("leaflets_without_wall_are_not_cut") {
  const WalledValve valve = with_wall(1600, 0, is_everywhere);
  const LeafletSheet whole = cut(valve.surface, {}).sheet;
  const auto check_whole = [&](const std::vector<Vec3> &points) {
    const CutLeaflets found = cut(valve.surface, points);
    CHECK(!find(found.findings, "atrial_tissue"));
    CHECK(found.sheet.x == whole.x);
  };
  check_whole(annulus_points(valve, 6, 0));
  check_whole(annulus_points(valve, 2, 1e-3));
  // those of the free edge are doubted, not cut along
  const ParametricSheet p = parametric_sheet(1600);
  const CutLeaflets edge = cut(valve.surface, points_of(p.sheet, p.rims.free_edge));
  CHECK(sheet_area(edge.sheet) == about(sheet_area(whole)));
}

TEST_CASE("too_few_points_do_not_cut_and_say_so") {
  const WalledValve valve = with_wall(430, 3, is_everywhere);
  std::vector<Vec3> points;
  for (size_t k = 0; k < 4; ++k) points.push_back(valve.annulus[k * valve.annulus.size() / 4]);
  const CutLeaflets few = cut(valve.surface, points);
  CHECK(!find(few.findings, "atrial_tissue"));
  CHECK(find(few.findings, "annulus")->sentence.find("six points") != std::string::npos);
  CHECK(find(few.findings, "annulus")->confidence < 0.6);
  // nor do many on one side
  points.assign(valve.annulus.begin(),
                valve.annulus.begin() + static_cast<std::ptrdiff_t>(valve.annulus.size() / 2));
  CHECK(annulus_through(points, 1e-3).empty());
}

TEST_CASE("the_annulus_found_by_a_cut_gives_the_same_bits_if_it_is_given") {
  const WalledValve valve = remeshed_with_wall(430, 4, 2e-3);
  PatientSurface surface;
  surface.points = valve.surface.x;
  surface.triangles = valve.surface.triangles;
  surface.annulus = annulus_points(valve, 3, 0.3e-3);
  BuildSettings settings;
  settings.finds_leak = false;
  const BuiltValve first = build_valve(surface, settings, {});
  const Finding *annulus = find(first.findings, "annulus");
  surface.annulus = points_in(*annulus);
  surface.commissures = points_in(*find(first.findings, "commissures"));
  surface.anterior = points_in(*find(first.findings, "anterior"));
  const BuiltValve again = build_valve(surface, settings, {});
  CHECK(first.model->valve.rest.get() == again.model->valve.rest.get());
  CHECK(first.model->valve.triangles.get() == again.model->valve.triangles.get());
  // triangles divided by the cut are remeshed: 0.35 rad is 20 degrees
  double worst = 2 * pi;
  const std::vector<Vec3> &x = first.model->valve.rest;
  for (const Tri &t : first.model->valve.triangles.get()) {
    for (size_t k = 0; k < 3; ++k) {
      const Vec3 a = x[t[(k + 1) % 3]] - x[t[k]], b = x[t[(k + 2) % 3]] - x[t[k]];
      worst = std::min(worst, std::atan2(a.cross(b).norm(), a.dot(b)));
    }
  }
  CHECK(worst > 0.35);
}

TEST_CASE("part_below_a_level_of_a_plane_has_the_area_of_the_half_plane") {
  // unit squares in the plane; the line 0.6 x + 0.8 y = 7.3 cuts a triangle off 20 x 20
  LeafletSheet sheet;
  for (int j = 0; j <= 20; ++j) {
    for (int i = 0; i <= 20; ++i) sheet.x.emplace_back(i, j, 0);
  }
  for (uint32_t j = 0; j < 20; ++j) {
    for (uint32_t i = 0; i < 20; ++i) {
      const uint32_t a = 21 * j + i;
      sheet.triangles.push_back({a, a + 1, a + 22});
      sheet.triangles.push_back({a, a + 22, a + 21});
      sheet.label.insert(sheet.label.end(), 2, LeafletLabel::anterior);
    }
  }
  std::vector<double> level;
  for (const Vec3 &p : sheet.x) {
    level.push_back(0.6 * p.x() + 0.8 * p.y() - 7.3);
    sheet.thickness.push_back(p.x());
  }
  std::vector<uint8_t> on_cut;
  const LeafletSheet below = part_below(sheet, level, 0, on_cut);
  const double area = 0.5 * (7.3 / 0.6) * (7.3 / 0.8);
  CHECK(sheet_area(below) == about(area, 1e-12));
  CHECK(below.label.size() == below.triangles.size());
  for (size_t i = 0; i < below.x.size(); ++i) {
    CHECK(std::abs(below.thickness[i] - below.x[i].x()) < 1e-12);  // rounding
    if (i < level.size()) continue;
    CHECK(on_cut[i] == 1);
    CHECK(0.6 * below.x[i].x() + 0.8 * below.x[i].y() == about(7.3));
  }
  // with snapping, no part of a divided edge is shorter than a tenth of it
  const LeafletSheet snapped = part_below(sheet, level, 0.1, on_cut);
  CHECK(sheet_area(snapped) == about(area, 0.02));
  for (const Tri &t : snapped.triangles) {
    for (size_t k = 0; k < 3; ++k) {
      CHECK((snapped.x[t[k]] - snapped.x[t[(k + 1) % 3]]).norm() > 0.0999);
    }
  }
}

TEST_CASE("a_curve_through_few_points_of_a_circle_is_near_the_circle") {
  for (const size_t count : {8u, 16u, 200u}) {
    std::vector<Vec3> points;
    for (size_t k = 0; k < count; ++k) {
      const double angle = 2 * pi * static_cast<double>(7 * k % count) / static_cast<double>(count);
      points.emplace_back(18e-3 * std::cos(angle), 18e-3 * std::sin(angle), 5e-3);
    }
    const std::vector<Vec3> curve = annulus_through(points, 0.5e-3);
    REQUIRE(curve.size() > 200);
    // in the middle between points, (18 cos(h) - 2 cos(3 h)) / 16 of the radius, h half their
    // angle: 0.9915 at 8 points, 0.9994 at 16; means of points within 2.5 mm lie 0.1 % inside
    const double tolerance = count == 8 ? 0.009 : 0.002;
    for (const Vec3 &p : curve) {
      CHECK(p.z() == about(5e-3));
      CHECK(std::hypot(p.x(), p.y()) == about(18e-3, tolerance));
    }
  }
}
