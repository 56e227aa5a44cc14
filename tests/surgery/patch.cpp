// Patches enlarge a leaflet by the requested area at the requested place, and improve closure.
#include <Eigen/Geometry>

#include "measure/tissue/surface.h"
#include "tests/about.h"
#include "tests/surgery/operated.h"

using namespace mvs::core;
using namespace mvs::core::test;

namespace {

mvs_op_patch patch_on(const ModelState &p, const std::string &scallop, double along,
                      double height) {
  auto op = op_of<mvs_op_patch>(MVS_OP_PATCH);
  op.site.how = MVS_SITE_ANATOMICAL;
  for (const Scallop &s : p.model->valve.scallops) {
    if (s.name == scallop) op.site.scallop = s.id;
  }
  op.site.u[0] = along;
  op.site.u[1] = height;
  return op;
}

}  // namespace

TEST_CASE("a_patch_has_the_requested_area_and_thickness_and_the_rest_stays") {
  const ModelState before = shipped();
  for (const double factor : {1.05, 1.3, 2.5}) {
    CAPTURE(factor);
    auto op = patch_on(before, "A2", 0.5, 0.5);
    op.area_factor = factor;
    op.thickness = 0.5 * mm;
    const ModelState after = apply(before, op).current;
    const Model &old = *before.model, &now = *after.model;
    CHECK(now.valve.triangles == old.valve.triangles);
    CHECK(after.state.x == before.state.x);
    double was = 0, is = 0;
    const Surface surface = surface_of(now.valve.triangles, now.valve.rest);
    const Surface flat = surface_of(old.valve.triangles, old.valve.rest);
    for (size_t t = 0; t < now.rest_area.size(); ++t) {
      if (now.valve.triangle_thickness[t] == old.valve.triangle_thickness[t]) {
        CHECK(now.rest_area[t] == old.rest_area[t]);
        continue;
      }
      CHECK(now.valve.triangle_thickness[t] == 0.5 * mm);
      was += old.rest_area[t];
      is += now.rest_area[t];
      CHECK(surface.normal[t].dot(flat.normal[t]) > 0);  // a dome, nowhere folded over
    }
    // bisection to the last bits
    CHECK(is == about(factor * was, 1e-9));
    CHECK(was > 0.8 * 3.14159 / 4 * 12 * mm * 8 * mm);  // an ellipse of triangles
    CHECK(was < 1.2 * 3.14159 / 4 * 12 * mm * 8 * mm);
    for (size_t c = 0; c < now.valve.chords.size(); ++c) {
      CHECK(now.valve.chords[c] == old.valve.chords[c]);
    }
  }
}

TEST_CASE("a_valve_with_a_patch_closes_and_coapts_more") {
  const ModelState before = shipped();
  const Closed plain = close(before);
  const double area = measure_coaptation(*plain.model, plain.state.x).area;
  for (const char *scallop : {"A2", "P2"}) {
    CAPTURE(scallop);
    auto op = patch_on(before, scallop, 0.5, 0.5);
    if (*scallop == 'P') op.width = 10 * mm;
    const Closed patched = close(apply(before, op).current);
    CHECK(patched.stats.converged);
    CHECK(intersections(patched) == 0);
    CHECK(measure_orifice(*patched.model, patched.state.x).area == 0);
    CHECK(measure_coaptation(*patched.model, patched.state.x).area > 1.03 * area);
  }
}

TEST_CASE("impossible_patches_are_refused") {
  const ModelState p = shipped();
  refused(p, patch_on(p, "A2", 0.5, 0.1), MVS_E_OP, "reach the annulus");
  refused(p, patch_on(p, "A2", 0.5, 0.9), MVS_E_OP, "reach the free edge");
  auto op = patch_on(p, "P1", 0.9, 0.5);
  op.height = 5 * mm;
  refused(p, op, MVS_E_OP, "reach another leaflet");
  op = patch_on(p, "P2", 0.5, 0.5);
  op.width = op.height = 2 * mm;
  refused(p, op, MVS_E_OP, "take a larger patch");
  op = patch_on(p, "A2", 0.5, 0.5);
  op.area_factor = 3;
  op.site.scallop = p.model->valve.heads[0].id;
  refused(p, op, MVS_E_ID, "not a scallop");
  op.area_factor = 4;
  refused(p, op, MVS_E_ARGUMENT, "area_factor is 4");
}
