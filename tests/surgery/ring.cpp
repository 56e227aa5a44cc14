// Rigid rings: shape, placement, and the annulus that they hold.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "surgery/ring/ring_curve.h"
#include "tests/about.h"
#include "tests/surgery/operated.h"

namespace mvs::core::test {
namespace {

constexpr double pi = std::numbers::pi;

mvs_op_ring sized(double size) {
  auto op = op_of<mvs_op_ring>(MVS_OP_RING);
  op.size = size;
  return op;
}

mvs_op_ring along(const std::vector<Vec3> &curve) {
  auto op = op_of<mvs_op_ring>(MVS_OP_RING);
  op.curve = array_of(curve);
  return op;
}

// Not its own mirror image in any plane, so that only one placement is right.
std::vector<Vec3> skew_ring(size_t count) {
  std::vector<Vec3> points;
  for (size_t k = 0; k < count; ++k) {
    const double t = 2 * pi * static_cast<double>(k) / static_cast<double>(count);
    points.emplace_back(13e-3 * std::cos(t) + 1.5e-3 * std::cos(2 * t - 0.7), 17e-3 * std::sin(t),
                        2.5e-3 * std::cos(2 * t) + 0.4e-3 * std::sin(t));
  }
  return points;
}

std::vector<Vec3> moved(std::vector<Vec3> points) {
  const Mat3 turn = Eigen::AngleAxisd(2.1, Vec3(1, -2, 0.5).normalized()).toRotationMatrix();
  for (Vec3 &p : points) p = turn * p + Vec3(0.3, -0.1, 0.2);
  return points;
}

double largest_difference(const Valve &a, const Valve &b) {
  double largest = 0;
  for (size_t n = 0; n < a.rest.size(); ++n) {
    largest = std::max(largest, (a.loaded[n] - b.loaded[n]).norm());
  }
  return largest;
}

double distance_to_curve(const Vec3 &p, const std::vector<Vec3> &curve) {
  double least = 1;
  for (size_t k = 0; k < curve.size(); ++k) {
    const Vec3 &a = curve[k], along = curve[(k + 1) % curve.size()] - a;
    const double t = std::clamp((p - a).dot(along) / along.squaredNorm(), 0.0, 1.0);
    least = std::min(least, (p - a - t * along).norm());
  }
  return least;
}

}  // namespace

TEST_CASE("the_parametric_ring_has_the_measures_of_a_physio_34") {
  const std::vector<Vec3> curve = parametric_ring(34.7 * mm, 26.1 * mm, 4.7 * mm);
  Vec3 low = curve[0], high = curve[0];
  double area = 0;
  for (size_t k = 0; k < curve.size(); ++k) {
    low = low.cwiseMin(curve[k]);
    high = high.cwiseMax(curve[k]);
    area += 0.5 * curve[k].cross(curve[(k + 1) % curve.size()])[2];
  }
  // its measures are given to 0.1 mm and 0.01 cm2; a polygon of 360 sides of 0.28 mm lies at most
  // 1 um inside its curve, and is shorter by 1e-5 of its length
  CHECK(high[1] - low[1] == about(34.7 * mm, 1e-4));
  CHECK(high[0] - low[0] == about(26.1 * mm, 1e-4));
  CHECK(high[2] - low[2] == about(4.7 * mm, 1e-4));
  CHECK(Loop(curve).length() == about(100.4 * mm, 1e-4));
  CHECK(area == about(7.40e-4, 1e-4));
  // along its own axes it measures the same: it lies in its best plane
  const Vec3 extent = extent_of(Loop(curve));
  CHECK((extent - Vec3(34.7, 26.1, 4.7) * mm).norm() < 3e-6);
  // A, its first point, is the highest; P, opposite, the second highest
  CHECK(curve[0][2] == high[2]);
  CHECK(curve[180][2] > 0.8 * high[2]);
}

TEST_CASE("a_ring_holds_the_annulus_on_its_curve_open_and_loaded") {
  const ModelState before = shipped();
  const Operated done = apply(before, sized(34 * mm));
  const Valve &valve = done.current.model->valve;
  REQUIRE(valve.rings.size() == 1);
  CHECK(valve.rings[0].id == done.made);
  CHECK(valve.rings[0].name == "ring");
  CHECK(valve.rings[0].kind == RingKind::rigid);
  for (const uint32_t node : valve.annulus) {
    CHECK(valve.open[node] == valve.loaded[node]);
    CHECK(distance_to_curve(valve.loaded[node], valve.rings[0].curve) < 1e-12);
  }
  // the rest shape and everything else of the valve are unchanged
  CHECK(valve.rest.get() == before.model->valve.rest.get());
  CHECK(valve.chords.get() == before.model->valve.chords.get());
  CHECK(done.title == "Sew in ring, 34.0 x 25.6 mm, perimeter 98.4 mm");
}

TEST_CASE("annulus_nodes_keep_their_arc_length_fraction_from_a") {
  const ModelState before = shipped();
  const Operated done = apply(before, sized(32 * mm));
  const Model &model = *done.current.model;
  const std::vector<uint32_t> &nodes = model.valve.annulus;
  const Loop old_loop(nodes, before.model->valve.loaded), ring(nodes, model.valve.loaded);
  for (size_t k = 0; k < nodes.size(); ++k) {
    const double was = old_loop.start_of(k) / old_loop.length();
    const double is = ring.start_of(k) / ring.length();
    // chords of a polygon through points of the curve, about 1.8 mm long: under 2e-3 of its length
    CHECK(std::abs(was - is) < 2e-3);
  }
}

TEST_CASE("the_a_point_of_the_ring_is_at_the_a_point_of_the_annulus") {
  const Operated done = apply(shipped(), sized(34 * mm));
  const Model &model = *done.current.model;
  const Landmarks marks = find_landmarks(model, Loop(model.valve.annulus, model.valve.loaded));
  const std::vector<Vec3> &curve = model.valve.rings[0].curve;
  // the ring starts at its A point; the landmark lies on a side of the polygon, 1.8 mm long
  CHECK((marks.a - curve[0]).norm() < 0.1 * mm);
  CHECK((marks.p - curve[180]).norm() < 0.1 * mm);
  const AnnulusMeasures m = measure_annulus(model, model.valve.loaded);
  CHECK(m.saddle_height == about(34 * mm * 4.7 / 34.7, 0.02));
}

TEST_CASE("frame_winding_and_start_of_a_curve_have_no_effect") {
  const ModelState before = shipped();
  const std::vector<Vec3> curve = skew_ring(200);
  const Valve straight = apply(before, along(curve)).current.model->valve;
  std::vector<Vec3> other = moved(curve);
  std::rotate(other.begin(), other.begin() + 57, other.end());
  // the search stops at 1e-9 of the length, where the sum of squares is flat: 1e-4 mm
  CHECK(largest_difference(straight, apply(before, along(other)).current.model->valve) < 1e-7);
  std::reverse(other.begin(), other.end());
  CHECK(largest_difference(straight, apply(before, along(other)).current.model->valve) < 1e-7);
}

TEST_CASE("a_closed_curve_may_repeat_its_first_point_at_its_end") {
  const ModelState before = shipped();
  const std::vector<Vec3> curve = skew_ring(200);
  const Valve once = apply(before, along(curve)).current.model->valve;
  std::vector<Vec3> repeated = curve;
  repeated.push_back(curve.front() + Vec3(0, 0, 1e-9));
  const Valve twice = apply(before, along(repeated)).current.model->valve;
  CHECK(twice.rings[0].curve == once.rings[0].curve);
  CHECK(twice.loaded.get() == once.loaded.get());
}

TEST_CASE("the_best_fit_of_the_annulus_to_itself_is_exact") {
  const ModelState before = shipped();
  const Valve &valve = before.model->valve;
  const Loop annulus(valve.annulus, valve.loaded);
  const Valve after = apply(before, along(moved(annulus.points()))).current.model->valve;
  CHECK(largest_difference(valve, after) < 1e-7);
}

TEST_CASE("landmarks_place_a_ring") {
  const ModelState before = shipped();
  const std::vector<Vec3> curve = skew_ring(100), far = moved(curve);
  const std::vector<Vec3> from = {far[0], far[30], far[60]};
  const std::vector<Vec3> to = {curve[0], curve[30], curve[60]};
  auto op = along(far);
  op.landmarks = array_of(from);
  op.landmarks_at = array_of(to);
  const Operated done = apply(before, op);
  for (const Vec3 &p : done.current.model->valve.rings[0].curve) {
    CHECK(distance_to_curve(p, curve) < 1e-12);
  }
}

TEST_CASE("a_new_ring_replaces_the_old_one") {
  const Operated first = apply(shipped(), sized(36 * mm));
  auto op = sized(32 * mm);
  op.name = "smaller";
  const Operated second = apply(first.current, op);
  const Valve &valve = second.current.model->valve;
  REQUIRE(valve.rings.size() == 1);
  CHECK(valve.rings[0].name == "smaller");
  CHECK(second.made != first.made);
}

TEST_CASE("the_valve_closes_with_any_ring_that_is_in_use") {
  const Closed healthy = close(shipped());
  for (const double size : {26 * mm, 30 * mm, 34 * mm, 40 * mm}) {
    CAPTURE(size);
    for (const ModelState &current : {shipped(), ModelState{healthy.model, healthy.state}}) {
      const Closed closed = close(apply(current, sized(size)).current);
      CHECK(closed.stats.converged);
      CHECK(intersections(closed) == 0);
      const Valve &valve = closed.model->valve;
      for (const uint32_t node : valve.annulus) CHECK(closed.state.x[node] == valve.loaded[node]);
    }
  }
}

TEST_CASE("impossible_rings_are_refused") {
  const ModelState valve = shipped();
  const auto none_given = op_of<mvs_op_ring>(MVS_OP_RING);
  refused(valve, none_given, MVS_E_ARGUMENT, "give a curve, or the size");
  const std::vector<Vec3> curve = skew_ring(40);
  auto op = along(curve);
  op.size = 34 * mm;
  refused(valve, op, MVS_E_ARGUMENT, "both a curve and a size");
  op.size = 0;
  op.saddle = 3 * mm;
  refused(valve, op, MVS_E_ARGUMENT, "shape a parametric ring");
  refused(valve, sized(4 * mm), MVS_E_ARGUMENT, "size is 0.004 m");
  refused(valve, sized(8 * mm), MVS_E_OP, "cannot be gathered below 25 %");
  refused(valve, along({curve.begin(), curve.begin() + 7}), MVS_E_ARGUMENT, "has 7 points");
  auto edited = curve;
  edited[12] = edited[11];
  refused(valve, along(edited), MVS_E_ARGUMENT, "points 11 and 12 of the curve lie at the same");
  edited = curve;
  std::swap(edited[5], edited[20]);
  refused(valve, along(edited), MVS_E_ARGUMENT, "crosses itself after points");
  refused(valve, along(std::vector<Vec3>(20, Vec3::Zero())), MVS_E_ARGUMENT, "at the same place");
  edited = curve;
  for (Vec3 &p : edited) p *= 1e-3;
  refused(valve, along(edited), MVS_E_ARGUMENT, "at least 0.005 m");
  for (Vec3 &p : edited) p *= 1e5;
  refused(valve, along(edited), MVS_E_ARGUMENT, "at most 0.1 m: looks like mm");
  for (Vec3 &p : edited) p *= 10;
  refused(valve, along(edited), MVS_E_ARGUMENT, "it has to be within 10 m: looks like mm");
  for (Vec3 &p : edited) p *= 0.1;
  for (Vec3 &p : edited) p = Vec3(0.01 * p[0], 1e-4 * p[1], 0);
  refused(valve, along(edited), MVS_E_ARGUMENT, "of the area of a circle");
}

TEST_CASE("degenerate_landmarks_are_refused") {
  const ModelState valve = shipped();
  const std::vector<Vec3> curve = skew_ring(40), line = {curve[0], 2 * curve[0], 3 * curve[0]};
  const std::vector<Vec3> three = {curve[0], curve[3], curve[20]};
  const std::vector<Vec3> swapped = {curve[3], curve[20], curve[0]};
  std::vector<Vec3> far = three;
  for (Vec3 &p : far) p += Vec3(0, 0, 0.05);
  auto op = along(curve);
  op.landmarks = array_of(three);
  refused(valve, op, MVS_E_ARGUMENT, "3 landmarks, but 0 places");
  op.landmarks_at = array_of(line);
  refused(valve, op, MVS_E_ARGUMENT, "places in landmarks_at lie on one line");
  op.landmarks_at = array_of(swapped);
  refused(valve, op, MVS_E_OP, "check their order");
  op.landmarks_at = array_of(far);
  refused(valve, op, MVS_E_OP, "from the annulus: check landmarks_at");
  op.landmarks = array_of(line);
  refused(valve, op, MVS_E_ARGUMENT, "the landmarks lie on one line");
}

}  // namespace mvs::core::test
