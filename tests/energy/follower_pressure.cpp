// Follower pressure: derivatives of its force, its potential inside a held rim, its resultant.
#include "energy/follower_pressure.h"

#include "tests/energy/terms.h"

using namespace mvs::core;
using namespace mvs::core::test;

namespace {

Model octahedron() {
  Valve valve;
  for (int k = 0; k < 3; ++k) {
    valve.rest.push_back(0.01 * Vec3::Unit(k));
    valve.rest.push_back(-0.01 * Vec3::Unit(k));
  }
  valve.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                     {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  return model_of_sheet(valve, {});
}

}  // namespace

TEST_CASE("pressure_has_the_derivatives_of_its_force_also_at_the_free_edge") {
  const Model model = free_valve();
  FollowerPressureTerm term(model);
  term.set_pressure(16e3);
  const Gradient gradient = [&](const Positions &y) {
    Positions g(y.size(), Vec3::Zero());
    term.gradient(y, g);
    return g;
  };
  for (const uint64_t seed : {1u, 2u}) {
    const Positions x = crumpled(model, seed);
    term.freeze(x);
    const Positions g = gradient(x);
    // a cubic: differences of it have an error of h^2 / length^2
    const Positions found =
        differences([&](const Positions &y) { return term.energy(y); }, x, 1e-6);
    CHECK(farthest(g, found) < 1e-7 * largest(g));

    HessianAssembler system;
    std::vector<Edge> pairs;
    term.add_pairs(pairs);
    system.set_pattern(model, pairs);
    system.clear();
    term.hessian(x, system);
    const Eigen::MatrixXd symmetric = dense(system);
    Eigen::MatrixXd skew(symmetric.rows(), symmetric.cols());
    for (Eigen::Index c = 0; c < skew.cols(); ++c) {
      Positions unit(x.size(), Vec3::Zero()), y = unit;
      unit[static_cast<size_t>(c / 3)][c % 3] = 1;
      term.add_skew(x, unit, y);
      skew.col(c) = flat(y);
    }
    const double size = symmetric.cwiseAbs().maxCoeff();
    // the force is quadratic in x, so that differences are exact but for rounding, 1e-16 / 1e-4
    const Eigen::MatrixXd slope = differences(gradient, x, 1e-6);
    CHECK((symmetric + skew - slope).cwiseAbs().maxCoeff() < 1e-9 * size);
    CHECK((skew + skew.transpose()).cwiseAbs().maxCoeff() < 1e-12 * size);
    // the free edge contributes an unsymmetric part
    CHECK(skew.cwiseAbs().maxCoeff() > 1e-3 * size);
  }
}

TEST_CASE("pressure_inside_a_prescribed_rim_has_a_potential") {
  const Model model = clamped_disc(4, 0.01, [](Valve &) {});
  FollowerPressureTerm term(model);
  term.set_pressure(1e3);
  Random random(3);
  Positions x = model.valve.rest, y(x.size(), Vec3::Zero());
  for (Vec3 &p : x) p += random.vector(1e-3);
  term.add_skew(x, random.vectors(x.size(), 1), y);
  CHECK(largest(y) == 0);
}

TEST_CASE("pressure_on_a_closed_surface_has_zero_resultant") {
  const Model model = octahedron();
  FollowerPressureTerm term(model);
  term.set_pressure(16e3);
  Random random(6);
  Positions x = model.valve.rest;
  for (Vec3 &p : x) p += random.vector(3e-3);
  Positions g(x.size(), Vec3::Zero());
  term.gradient(x, g);
  // rounding of eight areas
  CHECK(sum_of(g).norm() < 1e-14 * largest(g));
  CHECK(moment_of(x, g).norm() < 1e-14 * 0.01 * largest(g));
}

TEST_CASE("pressure_on_a_cap_equals_pressure_on_its_projected_area") {
  const Model model = clamped_disc(6, 0.012, [](Valve &) {});
  FollowerPressureTerm term(model);
  term.set_pressure(16e3);
  Positions x = model.valve.rest;
  for (Vec3 &p : x) p.z() = 50 * (0.012 * 0.012 - p.squaredNorm());
  Positions g(x.size(), Vec3::Zero());
  term.gradient(x, g);
  const double area = 0.5 * 36 * 0.012 * 0.012 * std::sin(2 * pi / 36);  // of a 36-gon
  const Vec3 force = -sum_of(g);
  // rounding
  CHECK(force.z() == about(16e3 * area, 1e-12));
  CHECK(force.head<2>().norm() < 1e-12 * force.z());
}
