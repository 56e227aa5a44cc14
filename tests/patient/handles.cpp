// Handles of sheets are cut, or refused.
#include "patient/surface/cut_handles.h"

#include <doctest/doctest.h>

#include "base/error.h"
#include "patient/findings.h"
#include "patient/surface/boundary.h"
#include "patient/surface/rims.h"
#include "patient/surface/shortest_loops.h"
#include "tests/patient/cleaned.h"
#include "tests/patient/surfaces.h"

using namespace mvs::core;
using namespace mvs::core::test;

// A funnel, `size` times as large, with a tube that joins two windows on opposite sides.
LeafletSheet with_tube(double size) {
  Surface s = without_stars(funnel(48, 12), {48 * 6, 48 * 6 + 24});
  for (Vec3 &p : s.x) p *= size;
  LeafletSheet sheet = cleaned(s);
  std::vector<std::vector<uint32_t>> windows;
  for (const std::vector<uint32_t> &loop : boundary_loops(sheet)) {
    if (loop.size() == 6) windows.push_back(loop);
  }
  REQUIRE(windows.size() == 2);
  const std::vector<uint32_t> &a = windows[0];
  std::vector<uint32_t> b(windows[1].rbegin(), windows[1].rend());
  for (size_t k = 0; k < 6; ++k) {
    const size_t m = (k + 1) % 6;
    sheet.triangles.push_back({a[m], a[k], b[k]});
    sheet.triangles.push_back({a[m], b[k], b[m]});
  }
  sheet.label.assign(sheet.triangles.size(), LeafletLabel::unknown);
  return sheet;
}

TEST_CASE("a_narrow_tube_is_cut_and_a_wide_one_is_refused") {
  Findings findings;
  LeafletSheet narrow = with_tube(1), wide = with_tube(3);
  CHECK(handle_count(narrow, 2) == 1);
  const std::vector<SurfaceLoop> loops = shortest_loops(narrow, longest_handle);
  REQUIRE(!loops.empty());
  // around the tube: the six sides of a window
  CHECK(loops[0].vertices.size() == 6);
  const SheetRims rims = find_rims(narrow, {}, findings);
  REQUIRE(find_finding(findings, "cut_handles") != nullptr);
  CHECK(find_finding(findings, "cut_handles")->value[0] == loops[0].length);
  CHECK(handle_count(narrow, 2) == 0);
  CHECK(rims.annulus.size() == 48);
  CHECK(rims.free_edge.size() == 48);
  CHECK(shortest_loops(narrow, longest_handle).empty());
  CHECK_THROWS_WITH_AS(find_rims(wide, {}, findings), doctest::Contains("1 handles more than 12"),
                       Error);
}

TEST_CASE("rims_follow_the_cut_of_a_handle_at_the_edge") {
  // a tube in place of two triangles, each with one corner on the free edge: all loops around it
  // pass one of these corners
  constexpr uint32_t round = 60, down = 8, edge = down * round;
  Surface s = funnel(round, down);
  const auto take = [&](uint32_t corner) {
    for (size_t t = 0; t < s.triangles.size(); ++t) {
      Tri tri = s.triangles[t];
      if (std::count_if(tri.begin(), tri.end(), [](uint32_t i) { return i >= edge; }) != 1)
        continue;
      const auto at = std::find(tri.begin(), tri.end(), corner);
      if (at == tri.end()) continue;
      std::rotate(tri.begin(), at, tri.end());
      s.triangles.erase(s.triangles.begin() + static_cast<std::ptrdiff_t>(t));
      return tri;
    }
    return Tri{none, none, none};
  };
  const auto [v, a, b] = take(edge + 10);
  const auto [w, c, d] = take(edge + 20);
  REQUIRE(v != none);
  REQUIRE(w != none);
  for (const Tri &t :
       {Tri{v, a, d}, Tri{v, d, w}, Tri{a, b, c}, Tri{a, c, d}, Tri{b, v, w}, Tri{b, w, c}}) {
    s.triangles.push_back(t);
  }
  LeafletSheet sheet = cleaned(s);
  const size_t before = boundary_loops(sheet)[1].size();
  Findings findings;
  SheetRims rims = find_rims(sheet, {}, findings);
  REQUIRE(find(findings, "cut_handles"));
  CHECK(rims.free_edge.size() > before);
  std::vector<std::vector<uint32_t>> loops = boundary_loops(sheet);
  REQUIRE(loops.size() == 2);
  for (std::vector<uint32_t> *rim : {&rims.annulus, &rims.free_edge}) {
    std::sort(rim->begin(), rim->end());
    CHECK(std::any_of(loops.begin(), loops.end(), [&](std::vector<uint32_t> loop) {
      std::sort(loop.begin(), loop.end());
      return loop == *rim;
    }));
  }
}
