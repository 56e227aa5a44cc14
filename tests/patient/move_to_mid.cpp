// The atrial side of a leaflet moves to its middle.
#include "patient/skin/mid_surface.h"

#include <doctest/doctest.h>

#include "base/math.h"
#include "geometry/intersect.h"
#include "patient/surface/boundary.h"
#include "tests/about.h"
#include "tests/patient/surfaces.h"
#include "tests/patient/thick_skin.h"

using namespace mvs::core;
using namespace mvs::core::test;

TEST_CASE("move_to_mid_moves_the_atrial_side_to_the_middle") {
  const Tissue &tissue = fine_tissue();
  const std::vector<Vec3> normal = vertex_normals(tissue.sheet);
  LeafletSheet side = tissue.sheet;
  for (size_t i = 0; i < side.x.size(); ++i) {
    const double thickness = thickness_at(side.x[i]);
    side.thickness.push_back(thickness);
    side.x[i] += 0.5 * thickness * normal[i];
  }
  LeafletSheet moved = side;
  Findings findings;
  move_to_mid(moved, 0, findings);
  const MidError e = error_of(moved, tissue.sheet);
  CAPTURE(e.worst);
  // before: a half
  CHECK(e.rms < 0.03);
  CHECK(e.covered == about(1, 0.01));
  CHECK(moved.thickness == side.thickness);
  CHECK(find_intersections(moved.x, moved.triangles).size() <=
        find_intersections(side.x, side.triangles).size());
  REQUIRE(find(findings, "mid_surface"));
  CHECK(find(findings, "mid_surface")->source == FindingSource::measured);
  CHECK(find(findings, "mid_surface")->value[0] == about(0.6e-3, 0.05));
}

TEST_CASE("move_to_mid_takes_the_given_thickness_where_the_sheet_has_none") {
  Tissue tissue = tissue_of(funnel(48, 12));
  const std::vector<Vec3> before = tissue.sheet.x;
  Findings findings;
  move_to_mid(tissue.sheet, 2e-3, findings);
  for (size_t i = 0; i < before.size(); ++i) {
    const Vec3 way = tissue.sheet.x[i] - before[i];
    CHECK(way.norm() == about(1e-3));
    CHECK(way.z() < 0);
    CHECK(way.x() * before[i].x() + way.y() * before[i].y() > 0);  // off the axis
  }
  CHECK(tissue.sheet.thickness.empty());
  CHECK(findings.back().source == FindingSource::assumed);
}

TEST_CASE("move_to_mid_stops_in_folds_that_are_narrower_than_the_tissue") {
  // waves of 4.8 mm whose crests have a radius of 0.8 mm, and tissue of 4 mm
  Surface s = funnel(120, 48);
  for (size_t i = 0; i < s.x.size(); ++i) {
    const size_t row = i / 120;
    const double wave = 0.75e-3 * math::cos(2 * 3.14159265358979 * static_cast<double>(row) / 16);
    s.x[i] += wave * Vec3(-s.x[i].x(), -s.x[i].y(), 2.0 / 3 * s.x[i].head<2>().norm()).normalized();
  }
  Tissue tissue = tissue_of(s);
  REQUIRE(find_intersections(tissue.sheet.x, tissue.sheet.triangles).empty());
  const LeafletSheet before = tissue.sheet;
  Findings findings;
  move_to_mid(tissue.sheet, 4e-3, findings);
  CHECK(find_intersections(tissue.sheet.x, tissue.sheet.triangles).empty());
  double way = 0;
  for (size_t i = 0; i < before.x.size(); ++i) {
    way = std::max(way, (tissue.sheet.x[i] - before.x[i]).norm());
  }
  CHECK(way == about(2e-3));
  CHECK(findings[0].value[0] < 1.9e-3);  // crests moved less
}

TEST_CASE("move_to_mid_makes_no_new_crossings_in_a_real_valve") {
  const Surface s = real_stl("real_mitral/open_1146.stl");
  if (s.x.empty()) {
    MESSAGE("skipped: no real_mitral/open_1146.stl in MVS_TEST_DATA or ../shared/data");
    return;
  }
  Tissue tissue = tissue_of(s);
  const std::vector<Edge> before = find_intersections(tissue.sheet.x, tissue.sheet.triangles);
  CHECK(before.size() == 4);
  Findings findings;
  move_to_mid(tissue.sheet, 2e-3, findings);
  for (const Edge &pair : find_intersections(tissue.sheet.x, tissue.sheet.triangles)) {
    CHECK(std::find(before.begin(), before.end(), pair) != before.end());
  }
  CHECK(findings[0].value[0] > 0.8e-3);
}
