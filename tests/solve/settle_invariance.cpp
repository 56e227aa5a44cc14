// Static closure depends on nothing but the state: rigid motions, used solvers, backends.
#include <doctest/doctest.h>

#include <Eigen/Geometry>

#include "anatomy/parametric.h"
#include "base/error.h"
#include "model/law.h"
#include "solve/solver.h"
#include "tests/solve/bench.h"
#include "tests/solve/moving_valve.h"

using namespace mvs::core;
using namespace mvs::core::test;

namespace {

bool same_bits(const State &a, const State &b) {
  return a.x == b.x && a.v == b.v && a.time == b.time && a.steps == b.steps;
}

}  // namespace

TEST_CASE("a_rigid_motion_of_the_membrane_moves_the_result_with_it") {
  const Motion motion = some_motion();
  const Model here = soft_disc(6);
  const Model there = clamped_disc(6, 12e-3, [&](Valve &v) { v.rest = motion(v.rest); });
  SolveOptions options;
  options.residual = 1e-9;
  const Settled a = settle(here, systole, 0, options), b = settle(there, systole, 0, options);
  REQUIRE(a.stats.converged);
  REQUIRE(b.stats.converged);
  // 1e-9 N over the softest stiffness of the stretched sheet, p h = 16 kPa * 2 mm = 32 N/m
  CHECK(farthest(motion(a.state.x), b.state.x) < 1e-9);
}

TEST_CASE("a_rigid_motion_of_the_valve_moves_the_result_with_it") {
  const Motion motion = some_motion();
  Valve valve = moving_valve(), turned = valve;
  turned.rest = motion(valve.rest);
  turned.loaded = motion(valve.loaded);
  const ModelPtr here = make_model(valve), there = make_model(turned);
  // at this pressure the valve does not fold, so that there is one equilibrium
  SolveOptions options;
  options.residual = 1e-9;
  const Settled a = settle(*here, 500, 1, options), b = settle(*there, 500, 1, options);
  REQUIRE(a.stats.converged);
  REQUIRE(b.stats.converged);
  // 1e-9 N over the softest mode, the free edge swinging on its chordae: p h = 500 Pa * 5 mm
  CHECK(farthest(motion(a.state.x), b.state.x) < 1e-8);
}

// An exponential law and folds: two closures that have limited different pairs in one step end
// 0.05 mm or more apart, both at rest.
TEST_CASE("a_rigid_motion_of_a_folding_valve_moves_the_result_with_it") {
  mvs_parametric_desc desc = {};
  desc.struct_size = sizeof desc;
  desc.vertices = 200;
  desc.shape = MVS_SHAPE_FOUNDING;
  Valve valve = make_parametric_valve(desc);
  for (Leaflet &leaflet : valve.leaflets) {
    leaflet.law = LeafletLawId::fung;
    leaflet.constants = default_constants(find_leaflet_law(leaflet.law)->constants);
  }
  const double degree = pi / 180;
  const Motion motion = {
      Eigen::AngleAxisd(37 * degree, Vec3(0.3, -0.5, 0.81).normalized()).toRotationMatrix(),
      {0.13, -0.27, 0.09}};
  Valve turned = valve;
  for (auto *places : {&turned.rest, &turned.open, &turned.loaded}) *places = motion(*places);
  for (Vec3 &fibre : turned.triangle_fibre.edit()) fibre = motion.turn * fibre;
  SolveOptions options;
  options.residual = 1e-8;
  const Settled a = settle(*make_model(valve), systole, 1, options),
                b = settle(*make_model(turned), systole, 1, options);
  REQUIRE(a.stats.converged);
  REQUIRE(b.stats.converged);
  CHECK(a.stats.iterations > 20);  // an easier closure would show nothing
  // 1e-8 N over the softest mode, p h = 16 kPa * 1 mm, is 6e-10 m: some of those, of both
  CHECK(farthest(motion(a.state.x), b.state.x) < 1e-8);
}

TEST_CASE("two_runs_and_a_used_solver_give_the_same_bits") {
  const ModelPtr model = make_model(moving_valve());
  const Model other = soft_disc(3);
  for (const SolverKind kind :
       {SolverKind::newton, SolverKind::implicit_euler, SolverKind::explicit_euler}) {
    CAPTURE(kind);
    SolveOptions options;
    options.solver = kind;
    options.max_iterations = kind == SolverKind::newton ? 0 : 60;
    const auto run = [&](Solver &solver) {
      State state = initial_state(*model);
      state.load = {systole, 1};
      solver.settle(*model, state, options, {});
      return state;
    };
    Solver fresh(Backend::fastest), used(Backend::fastest);
    State warm = initial_state(other);
    warm.load.pressure = 100;
    used.step(other, warm, {});
    used.settle(other, warm, {}, {});
    State stepped = initial_state(*model);
    stepped.load = {systole, 1};
    used.step(*model, stepped, {});
    const State first = run(fresh), second = run(fresh), third = run(used);
    CHECK(same_bits(first, second));
    CHECK(same_bits(first, third));
  }
}

TEST_CASE("backends_reach_the_same_equilibrium") {
  const Model model = soft_disc(6);
  SolveOptions options;
  options.residual = 1e-9;
  Positions first;
  for (const Backend backend : {Backend::block, Backend::eigen, Backend::cholmod}) {
    CAPTURE(backend);
    State state = initial_state(model);
    state.load.pressure = systole;
    try {
      Solver solver(backend);
      REQUIRE(solver.settle(model, state, options, {}).converged);
    } catch (const Error &error) {
      CHECK(error.code == MVS_E_UNSUPPORTED);
      continue;
    }
    if (first.empty()) first = state.x;
    // 1e-9 N over p h, as above
    CHECK(farthest(first, state.x) < 1e-9);
  }
}
