// Crossings that are put into sheets on purpose, and those of a real one, are removed by small
// moves.
#include "patient/surface/mend_crossings.h"

#include "geometry/intersect.h"
#include "geometry/triangle_bvh.h"
#include "patient/surface/crossing_flips.h"
#include "tests/patient/sheets.h"

using namespace mvs::core;
using namespace mvs::core::test;

namespace {

void check_mended(const CrossingReport &report, const LeafletSheet &sheet,
                  const std::vector<Vec3> &before, double largest) {
  CHECK(report.before > 0);
  CHECK(report.after == 0);
  CHECK(find_intersections(sheet.x, sheet.triangles).empty());
  double moved = 0;
  for (size_t v = 0; v < before.size(); ++v) {
    moved = std::max(moved, (sheet.x[v] - before[v]).norm());
  }
  CHECK(report.largest_move == moved);
  CHECK(moved < largest);
}

}  // namespace

TEST_CASE("a_sheet_without_crossings_is_not_changed") {
  ParametricSheet p = parametric_sheet(430);
  const LeafletSheet before = p.sheet;
  const CrossingReport report = mend_crossings(p.sheet, p.rims);
  CHECK(report.before == 0);
  CHECK(report.largest_move == 0);
  CHECK(p.sheet.x == before.x);
  CHECK(p.sheet.triangles == before.triangles);
}

TEST_CASE("vertices_pulled_past_their_neighbours_are_taken_back") {
  for (const uint32_t vertices : {430u, 1600u}) {
    const ParametricSheet p = parametric_sheet(vertices);
    const double edge = mean_edge(p.sheet);
    const Rows stars = rows_of(p.sheet.x.size(), p.sheet.triangles);
    std::vector<uint8_t> on_rim = marks_of(p.rims.annulus, p.sheet.x.size());
    for (const uint32_t v : p.rims.free_edge) on_rim[v] = 1;
    int pulled = 0;
    for (uint32_t v = 0; v < p.sheet.x.size() && pulled < 5; v += 41) {
      if (on_rim[v]) continue;
      ++pulled;
      LeafletSheet sheet = p.sheet;
      const uint32_t neighbour = neighbours_in(sheet.triangles, stars[v], v)[2];
      sheet.x[v] += 1.7 * (sheet.x[neighbour] - sheet.x[v]) + Vec3(1e-5, 2e-5, 3e-5);
      const std::vector<Vec3> before = sheet.x;
      // it was pulled by more than that
      check_mended(mend_crossings(sheet, p.rims), sheet, before, 1.2 * edge);
    }
    CHECK(pulled == 5);
  }
}

TEST_CASE("walls_that_were_pushed_through_each_other_are_separated") {
  constexpr double gap = 0.3e-3;
  for (const double wide : {0.4e-3, 2e-3}) {  // 0.4 mm: a single vertex
    for (const double deep : {0.5e-3, 0.8e-3}) {
      CAPTURE(wide);
      CAPTURE(deep);
      SheetWithRims w = wall_with_bulb(gap, 0.5e-3);
      const Vec3 centre = w.sheet.x[5 * w.rims.annulus.size() + 7];
      const Vec3 radial = Vec3(centre.x(), centre.y(), 0).normalized();
      for (size_t v = 0; v < w.sheet.x.size() / 2; ++v) {  // the outer wall
        const double off2 = (w.sheet.x[v] - centre).squaredNorm() / (wide * wide);
        w.sheet.x[v] -= deep * std::max(0.0, 1 - off2) * radial;
      }
      const std::vector<Vec3> before = w.sheet.x;
      const CrossingReport report = mend_crossings(w.sheet, w.rims);
      // by what one wall is past the other
      check_mended(report, w.sheet, before, deep - gap + 0.05e-3);
      const TriangleBvh bvh(w.sheet.triangles, w.sheet.x);
      for (size_t v = 0; v < before.size(); ++v) {
        // only a patch around them moves
        if ((before[v] - centre).norm() > 6e-3) REQUIRE(w.sheet.x[v] == before[v]);
      }
    }
  }
}

TEST_CASE("vertices_on_rims_move_along_them_only") {
  ParametricSheet p = parametric_sheet(430);
  const auto &annulus = p.rims.annulus;
  std::vector<Vec3> rim;
  rim.reserve(annulus.size());
  for (const uint32_t v : annulus) rim.push_back(p.sheet.x[v]);
  // the sheet next to the annulus folds over it: an inner vertex goes past the opposite side
  const Rows stars = rows_of(p.sheet.x.size(), p.sheet.triangles);
  const std::vector<uint8_t> at_annulus = marks_of(annulus, p.sheet.x.size());
  uint32_t inner = none;
  for (const uint32_t v : neighbours_in(p.sheet.triangles, stars[annulus[10]], annulus[10])) {
    if (!at_annulus[v]) inner = v;
  }
  REQUIRE(inner != none);
  const double pulled = 2 * (p.sheet.x[annulus[10]] - p.sheet.x[inner]).norm();
  p.sheet.x[inner] += 2 * (p.sheet.x[annulus[10]] - p.sheet.x[inner]) + Vec3(1e-5, 2e-5, 3e-5);
  p.sheet.x[inner] += 1.5 * (p.sheet.x[annulus[9]] - p.sheet.x[annulus[10]]);
  const std::vector<Vec3> before = p.sheet.x;
  check_mended(mend_crossings(p.sheet, p.rims), p.sheet, before, 2 * pulled);
  bool slid = false;
  for (size_t k = 0; k < rim.size(); ++k) {
    const Vec3 &x = p.sheet.x[annulus[k]];
    slid = slid || x != rim[k];
    double least2 = 1;
    for (size_t j = 0; j < rim.size(); ++j) {
      least2 = std::min(least2, closest_on_segment(x, rim[j], rim[(j + 1) % rim.size()]).distance2);
    }
    REQUIRE(std::sqrt(least2) < 1e-15);  // rounding
  }
  CHECK(slid);
}

TEST_CASE("crossings_that_are_left_are_counted") {
  // all of it in one plane: both halves of the ring lie on each other
  SheetWithRims flat = revolved({{10e-3, 4e-3}, {10e-3, 2e-3}, {10e-3, 0}}, 12);
  for (Vec3 &p : flat.sheet.x) p.y() = 0;
  const CrossingReport report = mend_crossings(flat.sheet, flat.rims);
  CHECK(report.before > 0);
  CHECK(report.after > 0);
  CHECK(report.after == find_intersections(flat.sheet.x, flat.sheet.triangles).size());
}

TEST_CASE("flips_return_the_crossings_that_are_left_until_no_flip_removes_one") {
  LeafletSheet sheet = parametric_sheet(1600).sheet;
  const double edge = mean_edge(sheet);
  uint32_t seed = 1;
  for (Vec3 &x : sheet.x) {
    for (int k = 0; k < 3; ++k) {
      seed = 1664525u * seed + 1013904223u;
      x[k] += 1.6 * edge * (seed / 4294967296.0 - 0.5);
    }
  }
  const std::vector<Edge> before = find_intersections(sheet.x, sheet.triangles);
  const std::vector<Tri> given = sheet.triangles;
  const std::vector<Edge> left = flip_crossings(sheet, before);
  CHECK(before.size() > 100);
  CHECK(left.size() < before.size());
  CHECK(left == find_intersections(sheet.x, sheet.triangles));
  CHECK(sheet.triangles != given);
  const std::vector<Tri> flipped = sheet.triangles;
  CHECK(flip_crossings(sheet, left) == left);
  CHECK(sheet.triangles == flipped);
}

TEST_CASE("the_crossings_of_the_real_sheet_are_removed") {
  SheetWithRims real = real_sheet();
  if (real.sheet.x.empty()) {
    MESSAGE("skipped: no real_mitral/open_1146.stl in MVS_TEST_DATA");
    return;
  }
  const std::vector<Vec3> before = real.sheet.x;
  const CrossingReport report = mend_crossings(real.sheet, real.rims);
  CHECK(report.before == 4);
  check_mended(report, real.sheet, before, 1e-3);
  SheetWithRims other = renumbered(before.empty() ? real.sheet : real_sheet().sheet, real.rims, 9);
  const std::vector<Vec3> other_before = other.sheet.x;
  check_mended(mend_crossings(other.sheet, other.rims), other.sheet, other_before, 1e-3);
}
