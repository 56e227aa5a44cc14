// Flexible bands: the part of the annulus that they shorten, and the part that stays.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/about.h"
#include "tests/surgery/operated.h"

namespace mvs::core::test {
namespace {

mvs_op_band band(double length, double factor) {
  auto op = op_of<mvs_op_band>(MVS_OP_BAND);
  op.length = length;
  op.factor = factor;
  return op;
}

double length_of(const std::vector<Vec3> &points) {
  double sum = 0;
  for (size_t k = 1; k < points.size(); ++k) sum += (points[k] - points[k - 1]).norm();
  return sum;
}

const std::vector<Vec3> &curve_of(const Operated &done) {
  return done.current.model->valve.rings[0].curve;
}

}  // namespace

TEST_CASE("a_band_has_its_length_and_its_ends_stay_at_the_trigones") {
  const ModelState before = shipped();
  const Operated full = apply(before, band(0, 1)), done = apply(before, band(70 * mm, 0));
  const std::vector<Vec3> &was = curve_of(full), &is = curve_of(done);
  CHECK(length_of(is) == about(70 * mm, 1e-12));
  CHECK(is.front() == was.front());
  CHECK(is.back() == was.back());
  const Valve &valve = done.current.model->valve;
  CHECK(valve.rings[0].kind == RingKind::band);
  CHECK(valve.rings[0].id == done.made);
  CHECK(valve.rings[0].name == "band");
  const double percent = 100 * 70 * mm / length_of(was);
  CHECK(done.title == format("Sew in band, 70.0 mm, %.0f %% of the posterior annulus", percent));
  // the annulus of the shipped valve has a node every 6 degrees or so: the trigone is the nearest
  const Frame frame = valve_frame(*before.model, before.model->valve.loaded);
  for (const Vec3 &end : {is.front(), is.back()}) {
    const Vec3 local = frame.local(end);
    const double degrees = std::abs(std::atan2(local[1], local[0])) * 180 / std::numbers::pi;
    CHECK(std::abs(degrees - 38) < 4);
  }
}

TEST_CASE("a_band_of_factor_1_moves_nothing") {
  const ModelState before = shipped();
  const Valve &a = before.model->valve;
  const ModelState after = apply(before, band(0, 1)).current;
  for (const uint32_t node : a.annulus) {
    CHECK((after.model->valve.loaded[node] - a.loaded[node]).norm() < 1e-15);
  }
}

TEST_CASE("only_the_posterior_annulus_moves_open_and_loaded_towards_the_trigones") {
  const ModelState before = shipped();
  const Operated done = apply(before, band(0, 0.8));
  const Valve &a = before.model->valve, &b = done.current.model->valve;
  const std::vector<Vec3> &curve = curve_of(done);
  const Vec3 middle = 0.5 * (curve.front() + curve.back());
  const Frame frame = valve_frame(*before.model, a.loaded);
  size_t moved = 0;
  for (uint32_t n = 0; n < a.rest.size(); ++n) {
    const Vec3 by = b.loaded[n] - a.loaded[n];
    CHECK((b.open[n] - a.open[n] - by).norm() < 1e-15);
    if (by.norm() == 0) continue;
    ++moved;
    CHECK((b.loaded[n] - middle).norm() < (a.loaded[n] - middle).norm());
    CHECK(frame.local(a.loaded[n])[0] < frame.local(curve.front())[0]);
  }
  CHECK(moved == curve.size() - 2);
  CHECK(a.rest.get() == b.rest.get());
}

TEST_CASE("a_band_replaces_a_ring") {
  auto ring = op_of<mvs_op_ring>(MVS_OP_RING);
  ring.size = 34 * mm;
  const Operated first = apply(shipped(), ring);
  auto op = band(0, 0.95);
  op.name = "C band";
  const Operated second = apply(first.current, op);
  REQUIRE(second.current.model->valve.rings.size() == 1);
  CHECK(second.current.model->valve.rings[0].name == "C band");
}

TEST_CASE("the_valve_closes_with_a_band_sewn_open_or_closed") {
  for (const double factor : {0.9, 0.8, 0.6}) {
    CAPTURE(factor);
    const Closed healthy = close(shipped());
    for (const ModelState &current : {shipped(), ModelState{healthy.model, healthy.state}}) {
      const Closed closed = close(apply(current, band(0, factor)).current);
      CHECK(closed.stats.converged);
      CHECK(intersections(closed) == 0);
    }
  }
}

TEST_CASE("impossible_band_lengths_are_refused") {
  const ModelState valve = shipped();
  refused(valve, band(0, 0), MVS_E_ARGUMENT, "either a length or a factor");
  refused(valve, band(70 * mm, 0.9), MVS_E_ARGUMENT, "either a length or a factor");
  refused(valve, band(90 * mm, 0), MVS_E_OP, "a band shortens it");
  refused(valve, band(10 * mm, 0), MVS_E_OP, "the trigones, which it joins");
  refused(valve, band(0, 1.2), MVS_E_ARGUMENT, "factor is 1.2");
  refused(valve, band(1, 0), MVS_E_ARGUMENT, "length is 1 m");
}

}  // namespace mvs::core::test
