// Skins and valves of leaflets a part of which, or all, is far thicker than normal ones.
#include <doctest/doctest.h>

#include <algorithm>

#include "patient/doubtful.h"
#include "patient/fit/thickness_range.h"
#include "patient/surface/boundary.h"
#include "tests/about.h"
#include "tests/patient/parametric_sheet.h"
#include "tests/patient/thick_skin.h"

using namespace mvs::core;
using namespace mvs::core::test;

namespace {

// m: 1 mm, and 4.5 mm within 6 mm of the middle of P2, from the annulus to the free edge, as that
// of a myxomatous scallop.
double thick_p2(const Vec3 &p) {
  const double away = (p - Vec3{0, -11.6e-3, -4e-3}).norm();
  return 1e-3 + 3.5e-3 * std::clamp((9e-3 - away) / 3e-3, 0.0, 1.0);
}

}  // namespace

TEST_CASE("the_middle_of_a_skin_has_parts_that_are_several_times_as_thick_as_the_rest") {
  // Without its thick part a side has a hole, or its rims are one.
  const Tissue &tissue = fine_tissue();
  for (const uint32_t rows : {1u, 4u}) {
    CAPTURE(rows);
    Findings findings;
    const LeafletSheet mid = mid_of(skin_of(tissue, rows, thick_p2), findings);
    const MidError e = error_of(mid, tissue.sheet, thick_p2);
    CHECK(e.rms < 0.15);
    // flanks of 3.5 mm over 3 mm, 9 % of the area, take the mean of what lies beside them
    CHECK(e.right_thickness > 0.85);
    CHECK(e.covered == about(1, 0.06));
    const double most = *std::max_element(mid.thickness.begin(), mid.thickness.end());
    CHECK(most == about(4.5e-3, 0.05));
    CHECK(boundary_loops(mid).size() == 2);
  }
}

TEST_CASE("thick_leaflets_on_a_fine_mesh_are_said_to_touch_too_late") {
  Valve valve = parametric_sheet(800).model->valve;
  for (const double thickness : {1e-3, 4e-3}) {
    valve.triangle_thickness.edit().assign(valve.triangles.size(), thickness);
    valve.contact_thickness = mvs::core::contact_thickness(valve);
    Findings findings;
    report_thin_contact(valve, findings);
    const Finding *thin = find(findings, "thin_contact");
    // triangles have sides of 2 mm: contact reaches no farther than 1.2
    REQUIRE((thin != nullptr) == (thickness == 4e-3));
    if (!thin) continue;
    CHECK(is_doubtful(*thin));
    CHECK(thin->value[0] == valve.contact_thickness);
    CHECK(thin->value[1] == about(thickness, 1e-12));  // rounding of the mean
  }
}
