// Closed leaflets given as skins: leaflets of which the atrial sides touch, as one body and as two.
#include "patient/skin/closed_skin.h"

#include <doctest/doctest.h>

#include "base/error.h"
#include "patient/findings.h"
#include "tests/about.h"
#include "tests/patient/voxel_skin.h"

using namespace mvs::core;
using namespace mvs::core::test;

namespace {

constexpr double thickness = 1.2e-3, size = 0.4e-3;
constexpr double belly = 12e-3, height = 8e-3, half_length = 10e-3;  // m

// Adds a rectangle of triangles with sides of about 1 mm; its normal is along a x b.
void add_rectangle(LeafletSheet &sheet, const Vec3 &corner, const Vec3 &a, const Vec3 &b) {
  const auto along = static_cast<uint32_t>(a.norm() / 1e-3);
  const auto across = static_cast<uint32_t>(b.norm() / 1e-3);
  const auto first = static_cast<uint32_t>(sheet.x.size());
  for (uint32_t j = 0; j <= across; ++j) {
    for (uint32_t i = 0; i <= along; ++i) {
      sheet.x.push_back(corner + a * (1.0 * i / along) + b * (1.0 * j / across));
    }
  }
  for (uint32_t j = 0; j < across; ++j) {
    for (uint32_t i = 0; i < along; ++i) {
      const uint32_t at = first + j * (along + 1) + i, up = at + along + 1;
      sheet.triangles.push_back({at, at + 1, up + 1});
      sheet.triangles.push_back({at, up + 1, up});
    }
  }
}

// A leaflet as seen along the coaptation line: a level belly to one side (+1, -1) and a part that
// hangs down beside the other leaflet. Normals into the atrium: up, and towards the other one.
LeafletSheet leaflet(double side) {
  LeafletSheet sheet;
  const double near = 0.5 * thickness;
  const Vec3 y(0, 2 * half_length, 0), x(side * belly, 0, 0), down(0, 0, -height);
  const Vec3 corner(side * near, -half_length, 0);
  if (side > 0) {
    add_rectangle(sheet, corner, x, y);
    add_rectangle(sheet, corner, y, down);
  } else {
    add_rectangle(sheet, corner, y, x);
    add_rectangle(sheet, corner, down, y);
  }
  return sheet;
}

LeafletSheet both_leaflets() {
  LeafletSheet both = leaflet(1);
  const LeafletSheet other = leaflet(-1);
  const auto first = static_cast<uint32_t>(both.x.size());
  both.x.insert(both.x.end(), other.x.begin(), other.x.end());
  for (const Tri &t : other.triangles) {
    both.triangles.push_back({first + t[0], first + t[1], first + t[2]});
  }
  return both;
}

ClosedSurface closed_of(const Surface &s) {
  return {s.x, s.triangles};
}

// That the middle lies on the leaflets, faces as they do, and covers them but for their rims.
void check_middle(const ClosedSurface &middle) {
  const LeafletSheet truth = both_leaflets();
  const TriangleBvh on_truth(truth.triangles, truth.x);
  double wrong = 0, far = 0, all = 0;
  for (const Tri &t : middle.triangles) {
    const Vec3 centre = (middle.points[t[0]] + middle.points[t[1]] + middle.points[t[2]]) / 3;
    const double area = triangle_area(middle.points, t);
    const auto near = on_truth.closest(centre);
    const Vec3 normal = area_normal(truth.x, truth.triangles[near.triangle]).normalized();
    all += area;
    // the angle of the fillet between belly and hanging part
    if (area_normal(middle.points, t).normalized().dot(normal) < 0.5) wrong += area;
    if (near.distance2 > 0.3e-3 * 0.3e-3) far += area;
  }
  CHECK(wrong < 0.06 * all);
  CHECK(far < 0.06 * all);
  const TriangleBvh on_middle(middle.triangles, middle.points);
  double missing = 0, whole = 0;
  for (const Tri &t : truth.triangles) {
    const Vec3 centre = (truth.x[t[0]] + truth.x[t[1]] + truth.x[t[2]]) / 3;
    // bands at the rims, of a thickness, are left out
    if (std::abs(centre.y()) > half_length - 1.5 * thickness ||
        std::abs(centre.x()) > belly - thickness || centre.z() < -height + 1.5 * thickness) {
      continue;
    }
    const double area = triangle_area(truth.x, t);
    whole += area;
    if (on_middle.closest(centre).distance2 > 0.5e-3 * 0.5e-3) missing += area;
  }
  CHECK(missing < 0.1 * whole);
}

}  // namespace

TEST_CASE("the_middle_of_leaflets_that_are_one_body_is_taken_from_their_outer_sides") {
  Findings findings;
  const Surface skin = voxel_skin(both_leaflets(), size, thickness, 10);
  const ClosedSurface middle = mid_of_closed(closed_of(skin), Vec3(0, 0, 1), findings);
  check_middle(middle);
  const Finding *found = find_finding(findings, "closed_skin");
  REQUIRE(found);
  // voxels whose centres are nearer than half a thickness
  CHECK(found->value[0] == about(thickness, 0.15));
  // both hanging parts, seen from the ventricle
  CHECK(found->value[2] == about(2 * height * 2 * half_length, 0.3));
}

TEST_CASE("the_middle_of_leaflets_that_are_two_bodies_is_taken_from_their_atrial_sides") {
  // faces of voxels that both have in common; and bodies 0.1 mm apart, one of them inside out
  for (const double apart : {0.0, 0.1e-3}) {
    ClosedSurface given;
    for (const double side : {1.0, -1.0}) {
      const Surface skin = voxel_skin(leaflet(side), size, thickness, 10);
      const auto first = static_cast<uint32_t>(given.points.size());
      for (const Vec3 &p : skin.x) given.points.push_back(p + Vec3(0.5 * side * apart, 0, 0));
      for (Tri t : skin.triangles) {
        if (side < 0 && apart > 0) std::swap(t[1], t[2]);
        given.triangles.push_back({first + t[0], first + t[1], first + t[2]});
      }
    }
    Findings findings;
    const ClosedSurface middle = mid_of_closed(given, Vec3(0, 0, 1), findings);
    check_middle(middle);
    const Finding *found = find_finding(findings, "closed_skin");
    REQUIRE(found);
    CHECK(found->value[2] < 0.1 * found->value[1]);
  }
}

TEST_CASE("closed_leaflets_that_are_sheets_are_taken_as_they_are") {
  const LeafletSheet both = both_leaflets();
  Findings findings;
  const ClosedSurface same = mid_of_closed({both.x, both.triangles}, Vec3(0, 0, 1), findings);
  CHECK(same.points == both.x);
  CHECK(same.triangles == both.triangles);
  CHECK(findings.empty());
  CHECK(mid_of_closed({}, Vec3(0, 0, 1), findings).points.empty());
}

TEST_CASE("a_closed_body_without_two_sides_is_refused") {
  const Cell count = {20, 20, 20};
  const Surface ball = cell_surface(Vec3::Zero(), 2e-3, count, [](const Cell &c) {
    return (Vec3(c[0], c[1], c[2]) - Vec3::Constant(10)).norm() < 9;
  });
  Findings findings;
  CHECK_THROWS_WITH_AS(mid_of_closed(closed_of(ball), Vec3(0, 0, 1), findings),
                       doctest::Contains("mid-surface"), Error);
}
