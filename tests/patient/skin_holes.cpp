// Holes of closed skins.
#include "patient/skin/skin_holes.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "base/error.h"
#include "model/sides.h"
#include "patient/surface/boundary.h"
#include "patient/surface/clean_surface.h"
#include "tests/about.h"
#include "tests/patient/parametric_sheet.h"
#include "tests/patient/surfaces.h"
#include "tests/patient/voxel_skin.h"

using namespace mvs::core;
using namespace mvs::core::test;

TEST_CASE("small_holes_of_a_skin_are_filled_and_rims_of_a_sheet_are_not") {
  LeafletSheet sheet = parametric_sheet(430).sheet;
  const Surface whole = voxel_skin(sheet, 0.7e-3, 1.5e-3, 5);
  Findings findings;
  const LeafletSheet closed = clean_surface(whole.x, whole.triangles, {}, {}, findings);
  REQUIRE(boundary_loops(closed).empty());
  const double area = surface_area(closed.x, closed.triangles);
  const auto without = [&](double radius) {
    // a triangle, and all triangles around another one
    LeafletSheet skin = closed;
    const Vec3 at = skin.x[skin.triangles[skin.triangles.size() / 2][0]];
    const Tri first = skin.triangles[0];
    std::erase_if(skin.triangles,
                  [&](const Tri &t) { return t == first || (skin.x[t[0]] - at).norm() < radius; });
    skin.label.assign(skin.triangles.size(), LeafletLabel::unknown);
    return skin;
  };
  LeafletSheet skin = without(1.2e-3);
  REQUIRE(boundary_loops(skin).size() == 2);
  findings.clear();
  fill_skin_holes(skin, findings);
  CHECK(boundary_loops(skin).empty());
  CHECK(surface_area(skin.x, skin.triangles) == about(area, 0.01));
  REQUIRE(find(findings, "skin_holes"));
  // 10 mm wide: an orifice
  LeafletSheet torn = without(5e-3);
  CHECK_THROWS_WITH_AS(fill_skin_holes(torn, findings), doctest::Contains("a skin with a hole of"),
                       Error);
  const std::vector<Tri> before = sheet.triangles;
  findings.clear();
  fill_skin_holes(sheet, findings);
  CHECK(sheet.triangles == before);
  CHECK(findings.empty());
}
