// Points that lie far from all of their neighbours.
#include "patient/checks/displaced_points.h"

#include <doctest/doctest.h>

#include "patient/doubtful.h"
#include "tests/patient/cleaned.h"
#include "tests/patient/parametric_sheet.h"
#include "tests/patient/surfaces.h"

using namespace mvs::core;
using namespace mvs::core::test;

TEST_CASE("a_displaced_vertex_is_moved_between_its_neighbours") {
  const ParametricSheet p = parametric_sheet(430);
  // of the annulus, of the free edge, between both
  for (const uint32_t i : {p.rims.annulus[3], p.rims.free_edge[7], 200u}) {
    CAPTURE(i);
    Surface s = surface_of(p.sheet);
    const Vec3 before = s.x[i];
    s.x[i] += Vec3(20e-3, -15e-3, 45e-3);
    Findings findings;
    const LeafletSheet sheet = cleaned(s, findings);
    REQUIRE(find(findings, "displaced_points"));
    CHECK(find(findings, "displaced_points")->sentence.find("1 point lay up to 5") !=
          std::string::npos);
    REQUIRE(sheet.x.size() == s.x.size());
    CHECK((sheet.x[i] - before).norm() < 2e-3);  // edges are 2 mm long
    for (size_t k = 0; k < s.x.size(); ++k) CHECK((k == i || sheet.x[k] == s.x[k]));
  }
}

TEST_CASE("a_band_of_long_thin_triangles_and_real_surfaces_have_no_displaced_points") {
  Findings findings;
  cleaned(funnel(400, 1), findings);  // sides of 0.2 and 14 mm
  cleaned(surface_of(parametric_sheet(1600).sheet), findings);
  const Surface real = real_stl("real_mitral/open_1146.stl");
  if (!real.x.empty()) cleaned(real, findings);
  CHECK(find(findings, "displaced_points") == nullptr);
}

TEST_CASE("tissue_that_reaches_far_from_the_annulus_is_a_doubtful_finding") {
  ParametricSheet p = parametric_sheet(430);
  Findings findings;
  doubt_far_tissue(p.sheet, p.rims, findings);
  CHECK(findings.empty());
  // two neighbours are displaced together, so that neither is far from all of its neighbours
  for (const uint32_t i : {p.rims.free_edge[7], p.rims.free_edge[8]}) {
    p.sheet.x[i] += Vec3(20e-3, -15e-3, -45e-3);
  }
  mend_displaced(p.sheet, findings);
  CHECK(findings.empty());
  doubt_far_tissue(p.sheet, p.rims, findings);
  REQUIRE(findings.size() == 1);
  CHECK(findings[0].name == "far_tissue");
  CHECK(is_doubtful(findings[0]));
}
