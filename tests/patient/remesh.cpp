// Remeshed sheets beside their input: size, quality, shape, rims, and walls that stay apart.
#include "base/error.h"
#include "geometry/intersect.h"
#include "geometry/triangle_bvh.h"
#include "model/winding.h"
#include "patient/mesh/remesh_sheet.h"
#include "patient/surface/mend_crossings.h"
#include "tests/about.h"
#include "tests/patient/sheets.h"

using namespace mvs::core;
using namespace mvs::core::test;

namespace {

constexpr double degree = 3.14159265358979 / 180;

double least_angle(const LeafletSheet &sheet) {
  double least = 3;
  for (const Tri &t : sheet.triangles) {
    for (size_t k = 0; k < 3; ++k) {
      const Vec3 a = sheet.x[t[(k + 1) % 3]] - sheet.x[t[k]];
      const Vec3 b = sheet.x[t[(k + 2) % 3]] - sheet.x[t[k]];
      least = std::min(least, std::atan2(a.cross(b).norm(), a.dot(b)));
    }
  }
  return least;
}

double distance_of_rim(const LeafletSheet &sheet, const std::vector<uint32_t> &loop,
                       const Vec3 &p) {
  double least2 = 1;
  for (size_t k = 0; k < loop.size(); ++k) {
    const Vec3 &a = sheet.x[loop[k]], &b = sheet.x[loop[(k + 1) % loop.size()]];
    least2 = std::min(least2, closest_on_segment(p, a, b).distance2);
  }
  return std::sqrt(least2);
}

bool same_loop(std::vector<uint32_t> a, std::vector<uint32_t> b) {
  std::sort(a.begin(), a.end());
  std::sort(b.begin(), b.end());
  return a == b;
}

// The properties of every result, whatever the input's shape.
void check_sheet(const RemeshedSheet &made, const LeafletSheet &from, const SheetRims &rims,
                 double edge) {
  const LeafletSheet &sheet = made.sheet;
  CHECK(find_intersections(sheet.x, sheet.triangles).empty());
  CHECK(made.report.crossings == 0);
  // one sheet, wound alike, of the topology of a ring: two rims and Euler's number 0
  const std::vector<Side> sides = sorted_sides(sheet.triangles);
  const Winding winding = find_winding(sheet.triangles, sides);
  CHECK(winding.component_count == 1);
  CHECK(std::count(winding.against.begin(), winding.against.end(), 1) == 0);
  size_t edges = 0;
  for_each_edge(sides, [&](size_t, size_t) { ++edges; });
  CHECK(sheet.x.size() + sheet.triangles.size() == edges);
  const auto loops = loops_by_length(sheet);
  REQUIRE(loops.size() == 2);
  const bool in_order = same_loop(loops[0], made.rims.annulus);
  CHECK(same_loop(loops[in_order ? 0 : 1], made.rims.annulus));
  CHECK(same_loop(loops[in_order ? 1 : 0], made.rims.free_edge));
  // rounding of positions of some cm is 1e-17 m
  constexpr double rounding = 1e-15;
  for (const uint32_t v : made.rims.annulus) {
    REQUIRE(distance_of_rim(from, rims.annulus, sheet.x[v]) < rounding);
  }
  for (const uint32_t v : made.rims.free_edge) {
    REQUIRE(distance_of_rim(from, rims.free_edge, sheet.x[v]) < rounding);
  }
  const TriangleBvh bvh(from.triangles, from.x);
  for (const Vec3 &p : sheet.x) REQUIRE(bvh.closest(p).distance2 < rounding * rounding);
  CHECK(made.report.worst_angle == about(least_angle(sheet)));
  // five per cent: the limits of splits and collapses follow the mean
  CHECK(mean_edge(sheet) == about(edge, 0.05));
  CHECK(made.report.mean_edge == about(mean_edge(sheet)));
  CHECK(made.report.longest < 1.7 * edge);
  CHECK(made.report.shortest > 0.4 * edge);
}

void check_lengths(const RemeshedSheet &made, const LeafletSheet &from, const SheetRims &rims,
                   double share) {
  CHECK(sheet_area(made.sheet) == about(sheet_area(from), share));
  CHECK(loop_length(made.sheet, made.rims.annulus) ==
        about(loop_length(from, rims.annulus), share));
  CHECK(loop_length(made.sheet, made.rims.free_edge) ==
        about(loop_length(from, rims.free_edge), share));
}

}  // namespace

TEST_CASE("parametric_sheets_are_remeshed_to_a_wanted_edge") {
  for (const uint32_t vertices : {430u, 1600u}) {
    const ParametricSheet p = parametric_sheet(vertices);
    for (const double factor : {0.7, 1.0, 1.5}) {
      CAPTURE(vertices);
      CAPTURE(factor);
      const double edge = factor * mean_edge(p.sheet);
      const RemeshedSheet made = remesh_sheet(p.sheet, p.rims, {edge});
      check_sheet(made, p.sheet, p.rims, edge);
      check_lengths(made, p.sheet, p.rims, 0.01);
      CHECK(made.report.worst_angle > 30 * degree);
      // the height of an arc over a chord of 1.5 edges at a radius of 3 edges is 0.1 edges, and
      // both surfaces are polyhedra
      CHECK(made.report.largest_distance < 0.2 * edge);
    }
  }
}

TEST_CASE("the_same_sheet_gives_the_same_bits") {
  const ParametricSheet p = parametric_sheet(430);
  const RemeshedSheet first = remesh_sheet(p.sheet, p.rims, {2e-3});
  const RemeshedSheet second = remesh_sheet(p.sheet, p.rims, {2e-3});
  CHECK(first.sheet.x == second.sheet.x);
  CHECK(first.sheet.triangles == second.sheet.triangles);
  CHECK(first.rims.annulus == second.rims.annulus);
}

TEST_CASE("a_renumbered_and_turned_sheet_gives_the_same_figures") {
  const ParametricSheet p = parametric_sheet(430);
  const double edge = mean_edge(p.sheet);
  const RemeshedSheet a = remesh_sheet(p.sheet, p.rims, {edge});
  for (const uint32_t seed : {5u, 6u}) {
    const SheetWithRims other = renumbered(p.sheet, p.rims, seed);
    const RemeshedSheet b = remesh_sheet(other.sheet, other.rims, {edge});
    check_sheet(b, other.sheet, other.rims, edge);
    CHECK(b.report.worst_angle > 30 * degree);
    // the order of equal edges differs
    CHECK(static_cast<double>(b.sheet.x.size()) ==
          about(static_cast<double>(a.sheet.x.size()), 0.03));
    CHECK(sheet_area(b.sheet) == about(sheet_area(a.sheet), 1e-3));
  }
}

TEST_CASE("noisy_sheets_are_remeshed_without_crossings") {
  for (const uint32_t vertices : {430u, 1600u}) {
    ParametricSheet p = parametric_sheet(vertices);
    const double noise = 0.2e-3, edge = mean_edge(p.sheet);
    disturb(p.sheet, noise, 7);
    const RemeshedSheet made = remesh_sheet(p.sheet, p.rims, {edge});
    check_sheet(made, p.sheet, p.rims, edge);
    CHECK(made.report.worst_angle > 30 * degree);
    // noise adds area that new vertices between the old ones do not have
    check_lengths(made, p.sheet, p.rims, 0.02);
    CHECK(made.report.largest_distance < 2 * noise);
  }
}

TEST_CASE("labels_and_thickness_come_from_the_place_on_the_input") {
  ParametricSheet p = parametric_sheet(430);
  for (size_t t = 0; t < p.sheet.triangles.size(); ++t) {
    p.sheet.label[t] =
        p.model->valve.triangle_scallop[t] < 3 ? LeafletLabel::anterior : LeafletLabel::posterior;
  }
  const auto thickness = [](const Vec3 &x) { return 1e-3 + 0.01 * x.x() - 0.02 * x.z(); };
  for (const Vec3 &x : p.sheet.x) p.sheet.thickness.push_back(thickness(x));
  const auto anterior_area = [](const LeafletSheet &sheet) {
    double area = 0;
    for (size_t t = 0; t < sheet.triangles.size(); ++t) {
      if (sheet.label[t] == LeafletLabel::anterior)
        area += triangle_area(sheet.x, sheet.triangles[t]);
    }
    return area;
  };
  const RemeshedSheet made = remesh_sheet(p.sheet, p.rims, {1.5e-3});
  REQUIRE(made.sheet.thickness.size() == made.sheet.x.size());
  for (size_t v = 0; v < made.sheet.x.size(); ++v) {
    // linear on each triangle, and vertices lie on triangles
    REQUIRE(made.sheet.thickness[v] == about(thickness(made.sheet.x[v]), 1e-12));
  }
  // triangles across the border of 2 x 20 mm have one of both labels
  CHECK(anterior_area(made.sheet) == about(anterior_area(p.sheet), 0.02));
}

TEST_CASE("walls_of_a_fold_stay_apart_and_are_not_exchanged") {
  constexpr double gap = 0.3e-3;
  const auto check_walls = [&](const LeafletSheet &sheet, double above) {
    // positions on chords of columns lie closer to the axis than their wall
    const double columns = std::round(2 * 3.14159265 * wall_radius / 0.5e-3);
    const double sag = wall_radius * (1 - std::cos(3.14159265 / columns));
    for (size_t t = 0; t < sheet.triangles.size(); ++t) {
      std::array<int, 2> corners{};  // on the inner and the outer wall
      for (const uint32_t v : sheet.triangles[t]) {
        const Vec3 &x = sheet.x[v];
        if (x.z() < above) continue;
        const double off = std::hypot(x.x(), x.y()) - wall_radius;
        ++corners[off > -0.5 * sag ? 1 : 0];
        REQUIRE(std::abs(std::abs(off + 0.5 * sag) - 0.5 * gap) < sag);
      }
      REQUIRE((corners[0] == 0 || corners[1] == 0));
      if (corners[0] + corners[1] == 3) {
        REQUIRE(sheet.label[t] == (corners[1] ? LeafletLabel::anterior : LeafletLabel::posterior));
      }
    }
  };
  SUBCASE("with a bulb") {
    const SheetWithRims w = wall_with_bulb(gap, 0.5e-3);
    const double edge = 1e-3;
    const RemeshedSheet made = remesh_sheet(w.sheet, w.rims, {edge});
    check_sheet(made, w.sheet, w.rims, edge);
    check_lengths(made, w.sheet, w.rims, 0.01);
    CHECK(made.report.worst_angle > 30 * degree);
    check_walls(made.sheet, 2e-3);
  }
  SUBCASE("narrower than the wanted edges") {
    const SheetWithRims w = hairpin(gap, 0.5e-3);
    const RemeshedSheet made = remesh_sheet(w.sheet, w.rims, {1.2e-3});
    CHECK(made.report.crossings == 0);
    // edges of 1.2 mm cut its bends off: 1.5 % of the area, 1.6 % of the free edge
    check_lengths(made, w.sheet, w.rims, 0.02);
    // the ridge of the fold is held by vertices that are closer than wanted
    CHECK(made.report.worst_angle > 15 * degree);
    CHECK(made.report.largest_distance < gap);
    check_walls(made.sheet, 1.5e-3);
  }
}

TEST_CASE("a_cleft_whose_sides_are_one_long_edge_each_is_remeshed") {
  // A sheet that bends inward, with a V cleft made by pulling up one column of a grid: needles 0.5
  // mm wide and up to 10 mm long, whose normals are those of their short sides. Their long edges
  // were not split, and triangles without area were left.
  constexpr uint32_t around = 96, rows = 14, cleft = 40;
  LeafletSheet sheet;
  SheetRims rims;
  for (uint32_t j = 0; j <= rows; ++j) {
    for (uint32_t i = 0; i < around; ++i) {
      const double side = i + 1 == cleft ? 0.5 : i == cleft + 1 ? -0.5 : 0;  // nearer to the cleft
      const double angle = 2 * 3.14159265358979 * (i + side) / around;
      const double down = (i == cleft ? 3e-3 : 13e-3) * j / rows, bend = down / 10e-3;
      const double radius = 16e-3 - 10e-3 * (1 - std::cos(bend));
      sheet.x.push_back(
          {radius * std::cos(angle), radius * std::sin(angle), -10e-3 * std::sin(bend)});
      if (j == rows) continue;
      const uint32_t a = j * around + i, b = j * around + (i + 1) % around;
      sheet.triangles.push_back({a, a + around, b + around});
      sheet.triangles.push_back({a, b + around, b});
    }
  }
  sheet.label.assign(sheet.triangles.size(), LeafletLabel::unknown);
  for (uint32_t i = 0; i < around; ++i) {
    rims.annulus.push_back(i);
    rims.free_edge.push_back(rows * around + i);
  }
  const RemeshedSheet made = remesh_sheet(sheet, rims, {1.1e-3});
  CHECK(made.report.crossings == 0);
  CHECK(made.report.worst_angle > 2 * degree);
  CHECK(made.report.longest < 2.5e-3);
  // the cut tip of the cleft takes 1.6 % of the free edge
  check_lengths(made, sheet, rims, 0.02);
}

TEST_CASE("the_real_sheet_is_mended_and_remeshed") {
  SheetWithRims real = real_sheet();
  if (real.sheet.x.empty()) {
    MESSAGE("skipped: no real_mitral/open_1146.stl in MVS_TEST_DATA");
    return;
  }
  REQUIRE(mend_crossings(real.sheet, real.rims).after == 0);
  const double edge = 1.5e-3;
  const RemeshedSheet made = remesh_sheet(real.sheet, real.rims, {edge});
  check_sheet(made, real.sheet, real.rims, edge);
  check_lengths(made, real.sheet, real.rims, 0.01);
  // one triangle of the free edge is curled over by 120 degrees: its obtuse corner stays
  CHECK(made.report.worst_angle > 25 * degree);
  CHECK(made.report.largest_distance < 0.4 * edge);  // at creases of the free edge
}

TEST_CASE("sheets_that_cannot_be_remeshed_are_refused") {
  const ParametricSheet p = parametric_sheet(430);
  CHECK_THROWS_WITH_AS(remesh_sheet(p.sheet, p.rims, {0}), doctest::Contains("must be positive"),
                       Error);
  CHECK_THROWS_WITH_AS(remesh_sheet(p.sheet, p.rims, {2e-6}), doctest::Contains("surface in m?"),
                       Error);
  const auto refused = [&](LeafletSheet sheet, const SheetRims &rims, const char *sentence) {
    sheet.label.resize(sheet.triangles.size());
    CHECK_THROWS_WITH_AS(remesh_sheet(sheet, rims, {2e-3}), doctest::Contains(sentence), Error);
  };
  LeafletSheet hole = p.sheet;
  std::vector<uint32_t> both_rims = p.rims.annulus;
  both_rims.insert(both_rims.end(), p.rims.free_edge.begin(), p.rims.free_edge.end());
  const std::vector<uint8_t> on_rim = marks_of(both_rims, p.sheet.x.size());
  const auto inside = std::find_if(hole.triangles.begin(), hole.triangles.end(), [&](const Tri &t) {
    return !on_rim[t[0]] && !on_rim[t[1]] && !on_rim[t[2]];
  });
  LeafletSheet turned = p.sheet, doubled = p.sheet;
  std::swap(turned.triangles[static_cast<size_t>(inside - hole.triangles.begin())][0],
            turned.triangles[static_cast<size_t>(inside - hole.triangles.begin())][1]);
  doubled.triangles.push_back(*inside);
  hole.triangles.erase(inside);
  refused(hole, p.rims, "fill its holes");
  refused(turned, p.rims, "wound against");
  refused(doubled, p.rims, "at most two");
  SheetRims broken = p.rims;
  broken.annulus.erase(broken.annulus.begin() + 5);
  refused(p.sheet, broken, "give it as the boundary loop");
}
