// Contact energy: derivatives, resultants, and the pressure between two sheets.
#include "energy/contact.h"

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "energy/forces.h"
#include "tests/about.h"
#include "tests/dense.h"
#include "tests/energy/touch.h"
#include "tests/model/small_valve.h"

using namespace mvs::core;
using namespace mvs::core::test;

namespace {

// Two plates of large elements whose nodes come as near as 0.1 of the contact thickness: every kind
// of pair occurs, also pairs with a barrier of their own.
Plates rough_plates() {
  return two_plates(3, 12e-3, 8e-3, false, [](Valve &v) { v.contact_thickness = 4e-3; });
}

Positions rough(const Plates &plates, uint64_t seed) {
  Random random(seed);
  Positions x = plates.at(1.2e-3);
  for (Vec3 &p : x) p += random.vector(0.45e-3);
  return x;
}

double plate_pressure(uint32_t cells, double gap) {
  const Plates plates =
      two_plates(cells, 10e-3, 4e-3, false, [](Valve &v) { v.contact_stiffness = 20e3; });
  const Positions x = plates.at(gap);
  const Positions g = Touch(plates.model, x, 0).gradient(x);
  // the contact force on the middle of the upper plate; rims are left out, since they feel each
  // other's edges
  double force = 0, area = 0;
  for (size_t i = plates.upper; i < x.size(); ++i) {
    const Vec3 from_middle = x[i] - Vec3(5e-3, 5e-3, gap);
    if (from_middle.cwiseAbs().maxCoeff() > 2.6e-3) continue;
    force -= g[i].z();
    area += plates.model.vertex_area[i];
  }
  return force / area;
}

}  // namespace

TEST_CASE("the_barrier_has_the_derivatives_of_its_value") {
  for (const auto curve : {barrier, penalty}) {
    const double first_slope = std::abs(curve(0.05).first);
    for (const double s : {0.05, 0.3, 0.5, 0.9, 0.999}) {
      const double h = 1e-6 * s;
      const Barrier b = curve(s), after = curve(s + h), before = curve(s - h);
      // (h / s)^2 and rounding of the value over h, against the first slope at s = 0.05
      CHECK(std::abs(b.first - (after.value - before.value) / (2 * h)) < 1e-8 * first_slope);
      CHECK(std::abs(b.second - (after.first - before.first) / (2 * h)) < 1e-7 * first_slope);
    }
    CHECK(curve(1).value == 0);
    CHECK(curve(1.5).first == 0);
    // C2 where it begins
    CHECK(std::abs(curve(1 - 1e-9).second) < 1e-7);
  }
}

TEST_CASE("contact_has_the_derivatives_of_its_energy") {
  const Plates plates = rough_plates();
  std::array<int, 3> slides{};
  int guards = 0, edge_edges = 0, negative = 0;
  for (const uint64_t seed : {1u, 2u, 3u}) {
    const Positions x = rough(plates, seed);
    Touch touch(plates.model, x, 1e-5);
    const Positions g = touch.gradient(x);
    for (const ContactPair &s : touch.contact_pairs()) {
      ++slides[s.slides];
      guards += s.is_barrier;
      edge_edges += s.weight[1] > 0;
      negative += s.strength < 0;
    }
    // h^2 / d^2 at the nearest pair, 1e-8 of 3e-4 m, and rounding 1e-16 / 1e-5
    const Positions found =
        differences([&](const Positions &y) { return touch.energy(y); }, x, 1e-8);
    CHECK(farthest(g, found) < 1e-6 * largest(g));
    const Eigen::MatrixXd h = touch.hessian(x, Curvature::exact);
    const Eigen::MatrixXd slope =
        differences([&](const Positions &y) { return touch.gradient(y); }, x, 1e-8);
    CHECK((h - slope).cwiseAbs().maxCoeff() < 1e-6 * h.cwiseAbs().maxCoeff());
  }
  // every kind occurred: points, edges, faces, barriers, edge pairs, counts of -1
  for (const int count : slides) CHECK(count > 0);
  CHECK(guards > 0);
  CHECK(edge_edges > 0);
  CHECK(negative > 0);
}

TEST_CASE("projected_contact_is_positive_semidefinite") {
  const Plates plates = rough_plates();
  const Positions x = rough(plates, 4);
  const Eigen::MatrixXd h = Touch(plates.model, x, 0).hessian(x, Curvature::projected);
  const Eigen::VectorXd values = symmetric_eigenvalues(h);
  // rounding
  CHECK(values.minCoeff() > -1e-12 * values.maxCoeff());
  CHECK(values.maxCoeff() > 0);
}

// The energy does not change while both plates turn, x' = w x x: v H v = -g (w x v), v = w x x. A
// Hessian without that curvature takes turning for free, and the pressure's is as negative there.
TEST_CASE("balanced_contact_keeps_the_curvature_of_plates_that_turn") {
  const Plates plates = two_plates(4, 10e-3, 4e-3, false, [](Valve &) {});
  Random random(6);
  Positions x = plates.at(0.5e-3);
  for (Vec3 &p : x) p += random.vector(0.05e-3);
  Touch touch(plates.model, x, 0);
  const Positions g = touch.gradient(x);
  const Vec3 turn(1, 0.3, 0.2);
  Positions velocity;
  double expected = 0;
  for (size_t i = 0; i < x.size(); ++i) {
    velocity.push_back(turn.cross(x[i]));
    expected -= g[i].dot(turn.cross(velocity.back()));
  }
  const Eigen::VectorXd v = flat(velocity);
  REQUIRE(!touch.contact_pairs().empty());
  for (const ContactPair &s : touch.contact_pairs()) CHECK_FALSE(s.is_barrier);
  const Eigen::MatrixXd balanced = touch.hessian(x, Curvature::balanced);
  const double found = v.dot(apply(balanced, v));
  // rounding of stiffness times 10 mm, squared
  CHECK(std::abs(found - expected) < 1e-9 * balanced.cwiseAbs().maxCoeff() * v.squaredNorm());
  const double without = v.dot(apply(touch.hessian(x, Curvature::projected), v));
  CHECK(std::abs(found - expected) < 1e-6 * std::abs(without - expected));
}

TEST_CASE("the_barrier_alone_is_projected_in_a_balanced_hessian") {
  const Plates plates = rough_plates();
  const Positions x = rough(plates, 4);
  Touch touch(plates.model, x, 0);
  const Eigen::MatrixXd balanced = touch.hessian(x, Curvature::balanced);
  CHECK(balanced != touch.hessian(x, Curvature::exact));
  CHECK(balanced != touch.hessian(x, Curvature::projected));
}

TEST_CASE("contact_moves_with_the_sheets_and_has_zero_resultant") {
  const Plates plates = rough_plates();
  const Positions x = rough(plates, 5);
  const Motion motion = some_motion();
  const Positions moved = motion(x);
  Touch here(plates.model, x, 0), there(plates.model, moved, 0);
  Positions g = here.gradient(x);
  Vec3 sum = Vec3::Zero(), snapshot = Vec3::Zero();
  for (size_t i = 0; i < x.size(); ++i) {
    sum += g[i];
    snapshot += x[i].cross(g[i]);
    g[i] = motion.turn * g[i];
  }
  // 1e-16 of 0.3 m over the nearest distance of 1e-4 m
  CHECK(farthest(g, there.gradient(moved)) < 1e-10 * largest(g));
  CHECK(there.energy(moved) == about(here.energy(x), 1e-10));
  CHECK(sum.norm() < 1e-12 * largest(g));
  CHECK(snapshot.norm() < 1e-12 * 0.02 * largest(g));
}

TEST_CASE("contact_pressure_between_plates_follows_the_gap_at_any_resolution") {
  for (const double gap : {0.4e-3, 0.6e-3, 0.8e-3}) {
    CAPTURE(gap);
    const double expected = -20e3 * barrier(gap / 1e-3).first;
    for (const uint32_t cells : {12u, 23u}) {
      CAPTURE(cells);
      // a node of a regular mesh gets its share of the force on the other plate, but for how the
      // nodes of both plates interleave: measured 1 % over the middle
      CHECK(plate_pressure(cells, gap) == about(expected, 0.02));
    }
  }
}

TEST_CASE("contact_is_zero_in_the_rest_shape_for_elements_of_any_size") {
  for (const double thickness : {0.5e-3, 2e-3, 8e-3}) {
    CAPTURE(thickness);
    Valve valve = small_valve();  // edges of 3 to 6 mm
    valve.contact_thickness = thickness;
    const ModelPtr model = make_model(valve);
    const Forces forces = evaluate_forces(*model, initial_state(*model));
    CHECK(largest(forces.contact) == 0);
  }
}

TEST_CASE("pressed_plates_rest_where_contact_balances_the_pressure") {
  const double pressure = 4e3;
  // where -kappa B'(s) = p, by bisection
  double low = 1e-3, high = 1;
  while (high - low > 1e-12) {
    const double middle = 0.5 * (low + high);
    (-20e3 * barrier(middle).first > pressure ? low : high) = middle;
  }
  const double expected = low * 1e-3;
  for (const uint32_t cells : {10u, 17u}) {
    CAPTURE(cells);
    const Plates plates = two_plates(cells, 20e-3, 1.6e-3, true, [](Valve &v) {
      v.leaflets.resize(1);
      v.leaflets[0].constants = {200e3, 200e3, 10};
    });
    const Settled settled = settle(plates.model, pressure);
    REQUIRE(settled.stats.converged);
    std::array<double, 2> height{};
    std::array<int, 2> count{};
    for (size_t i = 0; i < settled.state.x.size(); ++i) {
      const Vec3 &p = settled.state.x[i];
      if ((p - Vec3(10e-3, 10e-3, p.z())).norm() > 4e-3) continue;
      height[i < plates.upper ? 0 : 1] += p.z();
      ++count[i < plates.upper ? 0 : 1];
    }
    REQUIRE(count[0] > 3);
    REQUIRE(count[1] > 3);
    // two meshes that do not match bear the pressure unevenly by a few per cent, B' is steep
    CHECK(height[1] / count[1] - height[0] / count[0] == about(expected, 0.02));
  }
}
