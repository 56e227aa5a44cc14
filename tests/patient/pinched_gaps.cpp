// Gaps that open to a rim in one point.
#include "patient/surface/pinched_gaps.h"

#include <doctest/doctest.h>

#include "geometry/intersect.h"
#include "model/sides.h"
#include "patient/findings.h"
#include "patient/surface/boundary.h"
#include "tests/about.h"
#include "tests/patient/cleaned.h"
#include "tests/patient/surfaces.h"

using namespace mvs::core;
using namespace mvs::core::test;

TEST_CASE("gaps_that_open_to_a_rim_in_one_point_are_filled") {
  // a triangle and a larger gap, each with one corner on a rim, at both rims of a funnel
  constexpr uint32_t round = 60, down = 8;
  const Surface whole = funnel(round, down);
  const double area = surface_area(whole.x, whole.triangles);
  for (const uint32_t rim : {0u, down * round}) {
    for (const uint32_t wide : {1u, 3u}) {
      const uint32_t pinch = rim + 20;
      const auto is_near = [&](uint32_t i) {  // a corner between the rim and rows of `wide` cells
        const uint32_t row = i / round, column = i % round;
        const uint32_t depth = rim == 0 ? row : down - row;
        return i == pinch || (depth >= 1 && depth <= wide && column >= 19 && column <= 20 + wide);
      };
      Surface s = whole;
      std::erase_if(s.triangles,
                    [&](const Tri &t) { return std::all_of(t.begin(), t.end(), is_near); });
      const size_t gone = whole.triangles.size() - s.triangles.size();
      REQUIRE(gone >= wide);
      LeafletSheet sheet = cleaned(s);
      const size_t separate = sheet.x.size();
      Findings findings;
      fill_pinched_gaps(sheet, findings);
      INFO("rim ", rim, " wide ", wide);
      REQUIRE(find(findings, "pinched_gaps"));
      CHECK(find(findings, "pinched_gaps")->value.size() == 1);
      CHECK(boundary_loops(sheet).size() == 2);
      CHECK(surface_area(sheet.x, sheet.triangles) == about(area, 2e-3));
      CHECK(find_intersections(sheet.x, sheet.triangles).empty());
      // the rim passes the place once
      CHECK(std::count(sheet.x.begin(), sheet.x.end(), whole.x[pinch]) == 1);
      CHECK(sheet.x.size() >= separate - 1);
      CHECK(sheet.label.size() == sheet.triangles.size());
    }
  }
}

TEST_CASE("rims_that_touch_in_a_point_around_a_wide_gap_stay") {
  // half of the lower rim is pulled together in one point: two orifices, each no hole by its length
  constexpr uint32_t round = 60, down = 8;
  Surface s = funnel(round, down);
  s.x[down * round] = s.x[down * round + round / 2] = Vec3(0, 0, -12e-3);
  LeafletSheet sheet = cleaned(s);
  const LeafletSheet before = sheet;
  Findings findings;
  fill_pinched_gaps(sheet, findings);
  CHECK(findings.empty());
  CHECK(sheet.triangles == before.triangles);
}
