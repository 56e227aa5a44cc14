// Operations that move prescribed nodes only: scaling of the annulus, displacement of a papillary
// head.
#include <cmath>

#include "measure/annulus/landmarks.h"
#include "tests/about.h"
#include "tests/surgery/operated.h"

namespace mvs::core::test {
namespace {

mvs_op_annulus_scale scaled(double factor, double ap, double cc) {
  auto op = op_of<mvs_op_annulus_scale>(MVS_OP_ANNULUS_SCALE);
  op.factor = factor;
  op.ap = ap;
  op.cc = cc;
  return op;
}

AnnulusMeasures loaded_annulus(const ModelState &current) {
  return measure_annulus(*current.model, current.model->valve.loaded);
}

void tissue_is_untouched(const ModelState &before, const ModelState &after) {
  const Valve &a = before.model->valve, &b = after.model->valve;
  CHECK(a.rest.get() == b.rest.get());
  CHECK(a.triangles.get() == b.triangles.get());
  CHECK(a.chords.get() == b.chords.get());
  CHECK(before.model->rest_length.get() == after.model->rest_length.get());
  CHECK(before.state.x.get() == after.state.x.get());
}

}  // namespace

TEST_CASE("a_scaled_annulus_has_the_square_of_the_factor_in_area_and_the_tissue_stays") {
  const ModelState before = shipped();
  const AnnulusMeasures was = loaded_annulus(before);
  for (const double factor : {0.25, 0.8, 1.15}) {
    CAPTURE(factor);
    const ModelState after = apply(before, scaled(factor, 0, 0)).current;
    const AnnulusMeasures is = loaded_annulus(after);
    // rounding
    CHECK(is.area == about(factor * factor * was.area, 1e-12));
    CHECK(is.perimeter == about(factor * was.perimeter, 1e-12));
    CHECK(is.saddle_height == about(factor * was.saddle_height, 1e-12));
    tissue_is_untouched(before, after);
  }
}

TEST_CASE("an_annulus_is_scaled_along_its_axes_open_and_loaded") {
  const ModelState before = shipped();
  const Operated done = apply(before, scaled(0, 0.8, 1.1));
  const Valve &a = before.model->valve, &b = done.current.model->valve;
  const Frame loaded = valve_frame(*before.model, a.loaded),
              open = valve_frame(*before.model, a.open);
  for (const uint32_t node : a.annulus) {
    // rounding of 100 sums; rows of a frame are AP, CC and the axis
    const Vec3 factors(0.8, 1.1, 1);
    const Vec3 is = loaded.local(b.loaded[node]), is_open = open.local(b.open[node]);
    CHECK((is - loaded.local(a.loaded[node]).cwiseProduct(factors)).norm() < 1e-15);
    CHECK((is_open - open.local(a.open[node]).cwiseProduct(factors)).norm() < 1e-15);
  }
  tissue_is_untouched(before, done.current);
  CHECK(done.title == "Scale the annulus to 80 % (AP) and 110 % (CC)");
}

TEST_CASE("an_annulus_that_a_ring_or_band_holds_is_not_scaled") {
  auto ring = op_of<mvs_op_ring>(MVS_OP_RING);
  ring.size = 34 * mm;
  auto band = op_of<mvs_op_band>(MVS_OP_BAND);
  band.factor = 0.9;
  refused(apply(shipped(), ring).current, scaled(0.9, 0, 0), MVS_E_OP,
          "ring ring holds the annulus");
  refused(apply(shipped(), band).current, scaled(0, 1.1, 0), MVS_E_OP,
          "band band holds the annulus");
  // before the ring it may be
  apply(apply(shipped(), scaled(1.2, 0, 0)).current, ring);
}

TEST_CASE("an_annulus_is_scaled_between_the_limits_of_a_ring") {
  const ModelState before = shipped();
  const double rest = Loop(before.model->valve.annulus, before.model->valve.rest).length();
  const double share = loaded_annulus(before).perimeter / rest;
  apply(before, scaled(0.251 / share, 0, 0));
  refused(before, scaled(0.249 / share, 0, 0), MVS_E_OP, "cannot be gathered below 25 %");
  ModelState current = apply(before, scaled(0.5, 0, 0)).current;
  refused(current, scaled(0.4, 0, 0), MVS_E_OP, "take a larger factor");
  current = apply(before, scaled(1.9, 0, 0)).current;
  refused(current, scaled(1.9, 0, 0), MVS_E_OP,
          "at most 300 % are possible, take a smaller factor");
}

TEST_CASE("a_head_moves_along_the_axes_of_the_scene_or_of_the_valve") {
  const ModelState before = shipped();
  const Head head = before.model->valve.heads[1];
  auto op = op_of<mvs_op_head_move>(MVS_OP_HEAD_MOVE);
  op.head = head.id;
  op.by[0] = 3 * mm;
  op.by[2] = -1 * mm;
  for (const uint32_t frame : {0u, 1u}) {
    CAPTURE(frame);
    op.frame = frame;
    const ModelState after = apply(before, op).current;
    const Frame axes = valve_frame(*before.model, before.model->valve.loaded);
    const Vec3 by = frame == 0 ? Vec3(3 * mm, 0, -1 * mm)
                               : Vec3(3 * mm * axes.axes.row(0) - 1 * mm * axes.axes.row(2));
    const Valve &a = before.model->valve, &b = after.model->valve;
    for (uint32_t n = 0; n < a.rest.size(); ++n) {
      const Vec3 expected = n == head.node ? by : Vec3(0, 0, 0);
      CHECK((b.loaded[n] - a.loaded[n] - expected).norm() < 1e-15);
      CHECK((b.open[n] - a.open[n] - expected).norm() < 1e-15);
    }
    tissue_is_untouched(before, after);
  }
  op.by[0] = op.by[2] = 0;
  refused(before, op, MVS_E_ARGUMENT, head.name + " has a displacement of zero");
  op.by[1] = 0.06;
  refused(before, op, MVS_E_ARGUMENT, "within 0.05 m");
}

TEST_CASE("the_valve_closes_with_a_scaled_annulus_and_with_a_moved_head") {
  const ModelState before = shipped();
  auto head = op_of<mvs_op_head_move>(MVS_OP_HEAD_MOVE);
  head.head = before.model->valve.heads[0].id;
  head.by[2] = -3 * mm;
  for (const ModelState &current :
       {apply(before, scaled(0.9, 0, 0)).current, apply(before, scaled(1.15, 0, 0)).current,
        apply(before, scaled(0.25, 0, 0)).current, apply(before, head).current}) {
    const Closed closed = close(current);
    CHECK(closed.stats.converged);
    CHECK(intersections(closed) == 0);
  }
}

}  // namespace mvs::core::test
