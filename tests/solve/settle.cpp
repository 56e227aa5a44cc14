// Static closure: converges, reports convergence truthfully, and depends on nothing but the state.
#include <doctest/doctest.h>

#include <mvs/sim.h>

#include <Eigen/Geometry>
#include <cmath>

#include "anatomy/parametric.h"
#include "base/error.h"
#include "energy/forces.h"
#include "geometry/intersect.h"
#include "model/checks/check.h"
#include "model/law.h"
#include "tests/model/real_valves.h"
#include "tests/model/small_valve.h"
#include "tests/solve/bench.h"

using namespace mvs::core;
using namespace mvs::core::test;

namespace {

constexpr double systole = MVS_SYSTOLE_PA;

// The largest force on a free node, recomputed from the state alone.
double residual_of(const Model &model, const State &state) {
  const Forces forces = evaluate_forces(model, state);
  double most = 0;
  for (size_t i = 0; i < state.x.size(); ++i) {
    if (!model.topology.fixed[i]) most = std::max(most, forces.total[i].norm());
  }
  return most;
}

// At rest, as reported, and without self-intersection.
void check_rest(const Model &model, const Settled &settled, double tolerance) {
  CHECK(settled.stats.converged);
  CHECK(settled.stats.residual <= tolerance);
  // the same sums over the same numbers; near rest they cancel, forces themselves are below 1 N
  CHECK(residual_of(model, settled.state) ==
        doctest::Approx(settled.stats.residual).epsilon(1e-12).scale(1));
  CHECK(find_intersections(settled.state.x, model.valve.triangles).empty());
  CHECK(largest(settled.state.v) == 0);
}

Valve moving_valve() {
  Valve valve = small_valve();
  valve.loaded = valve.rest;
  for (const uint32_t node : valve.annulus) {
    valve.loaded[node].x() *= 0.92;
    valve.loaded[node].z() -= 1e-3;
  }
  for (const Head &head : valve.heads) valve.loaded[head.node].z() += 2e-3;
  return valve;
}

Model soft_disc(uint32_t rings) {
  return clamped_disc(rings, 12e-3, [](Valve &) {});
}

bool same_bits(const State &a, const State &b) {
  return a.x == b.x && a.v == b.v && a.time == b.time && a.steps == b.steps;
}

}  // namespace

TEST_CASE("a_valve_converges_at_any_pressure_without_crossing_itself") {
  const ModelPtr model = make_model(moving_valve());
  for (const double pressure : {0.0, 500.0, 4e3, systole, 30e3}) {
    CAPTURE(pressure);
    const Settled settled = settle(*model, pressure, 1);
    check_rest(*model, settled, 1e-5);
    for (uint32_t i = 0; i < model->node_count(); ++i) {
      // the boundary is at its target, to the bit
      if (model->topology.fixed[i]) CHECK(settled.state.x[i] == model->target(i, 1));
    }
  }
}

TEST_CASE("reactions_balance_the_pressure") {
  const ModelPtr model = make_model(moving_valve());
  const Settled settled = settle(*model, systole, 1);
  REQUIRE(settled.stats.converged);
  const Forces forces = evaluate_forces(*model, settled.state);
  // the force of the pressure itself, from the triangles
  Vec3 pushed = Vec3::Zero(), reaction = Vec3::Zero(), contact = Vec3::Zero();
  const auto &x = settled.state.x;
  for (const Tri &t : model->valve.triangles) {
    const Vec3 a = x[t[1]] - x[t[0]], b = x[t[2]] - x[t[0]];
    pushed += 0.5 * systole *
              Vec3(a.y() * b.z() - a.z() * b.y(), a.z() * b.x() - a.x() * b.z(),
                   a.x() * b.y() - a.y() * b.x());
  }
  for (size_t i = 0; i < x.size(); ++i) {
    if (model->topology.fixed[i]) reaction += forces.total[i];
    contact += forces.contact[i];
  }
  // total forces on prescribed nodes are the reactions; 66 nodes out of balance by up to 1e-5 N
  // each
  CHECK((reaction - pushed).norm() < 66 * 1e-5);
  CHECK(pushed.norm() > 1);
  CHECK(contact.norm() < 1e-12);  // contact acts on both sides alike: rounding
}

TEST_CASE("clamped_membranes_flat_or_domed_converge") {
  for (const double pressure : {10.0, 1e3, systole}) {
    CAPTURE(pressure);
    const Model flat = soft_disc(8);
    check_rest(flat, settle(flat, pressure), 1e-5);
    const Model domed = clamped_disc(8, 12e-3, [](Valve &v) {
      for (Vec3 &p : v.rest) p.z() = 30 * (144e-6 - p.squaredNorm());
    });
    check_rest(domed, settle(domed, pressure), 1e-5);
  }
}

TEST_CASE("a_tighter_tolerance_is_reached") {
  const Model model = soft_disc(6);
  SolveOptions options;
  options.residual = 1e-10;
  check_rest(model, settle(model, systole, 0, options), 1e-10);
}

TEST_CASE("a_closure_that_did_not_converge_is_reported_as_such") {
  const ModelPtr model = make_model(moving_valve());
  SolveOptions options;
  options.max_iterations = 3;
  const Settled settled = settle(*model, systole, 1, options);
  CHECK_FALSE(settled.stats.converged);
  CHECK(settled.stats.iterations == 3);
  CHECK(settled.stats.residual > 1e-5);
}

TEST_CASE("a_valve_at_rest_stays_where_it_is") {
  const ModelPtr model = make_model(small_valve());
  const Settled settled = settle(*model, 0);
  CHECK(settled.stats.converged);
  CHECK(settled.stats.iterations == 0);
  CHECK(settled.state.x == model->valve.rest);
}

TEST_CASE("a_settled_valve_settles_again_without_iterations") {
  const ModelPtr model = make_model(moving_valve());
  const Settled once = settle(*model, systole, 1);
  REQUIRE(once.stats.converged);
  const Settled twice = settle(*model, once.state);
  CHECK(twice.stats.converged);
  CHECK(twice.stats.iterations == 0);
  CHECK(twice.state.x == once.state.x);
}

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

TEST_CASE("progress_is_reported_and_can_cancel") {
  const ModelPtr model = make_model(moving_valve());
  for (const SolverKind kind :
       {SolverKind::newton, SolverKind::implicit_euler, SolverKind::explicit_euler}) {
    CAPTURE(kind);
    SolveOptions options;
    options.solver = kind;
    options.residual = 1e-14;  // not reached before the third call
    State state = initial_state(*model);
    state.load = {systole, 1};
    Solver solver(Backend::fastest);
    int calls = 0;
    bool sound = true;
    try {
      solver.settle(*model, state, options, [&](double share, double residual) {
        sound = sound && share >= 0 && share <= 1 && std::isfinite(residual);
        return ++calls < 3;
      });
      FAIL("was not cancelled");
    } catch (const Error &error) {
      CHECK(error.code == MVS_E_CANCELLED);
    }
    CHECK(calls == 3);
    CHECK(sound);
  }
}

// An iteration of a fine valve takes a second: the host is asked before each factorisation and each
// solution with the factor, wherever it cancels.
TEST_CASE("the_host_can_cancel_within_an_iteration") {
  const ModelPtr model = make_model(moving_valve());
  Solver solver(Backend::fastest);
  const auto settle = [&](uint32_t &calls, uint32_t most) {
    State state = initial_state(*model);
    state.load = {systole, 1};
    return solver.settle(*model, state, {}, [&](double, double) { return ++calls < most; });
  };
  uint32_t all = 0;
  const SolveStats stats = settle(all, none);
  CHECK(all > stats.iterations + 2 * stats.factorisations);
  for (uint32_t most = 1; most <= all; most += 1 + all / 12) {
    uint32_t calls = 0;
    CHECK_THROWS_AS(settle(calls, most), Error);
    CHECK(calls == most);
  }
}

TEST_CASE("numbers_out_of_range_are_refused") {
  const ModelPtr model = make_model(small_valve());
  State state = initial_state(*model);
  state.x[40] = state.x[41];  // coincident nodes have no direction between them
  Solver solver(Backend::fastest);
  try {
    solver.settle(*model, state, {}, {});
    FAIL("took coincident nodes");
  } catch (const Error &error) {
    CHECK(error.code == MVS_E_DIVERGED);
  }
}

TEST_CASE("the_valve_that_took_febio_107_seconds_closes") {
  const nlohmann::json json = read_real_valve("febio/V1_healthy_468.json");
  if (json.is_null()) {
    MESSAGE("skipped: no febio/V1_healthy_468.json in MVS_TEST_DATA or ../shared/data");
    return;
  }
  Valve valve = febio_valve(json);
  orient(valve);
  valve.loaded = valve.rest;
  for (size_t k = 0; k < valve.annulus.size(); ++k) {
    valve.loaded[valve.annulus[k]] = in_metres(json["annulus_loaded"][k]);
  }
  for (size_t k = 0; k < valve.heads.size(); ++k) {
    valve.loaded[valve.heads[k].node] = in_metres(json["papillary_loaded"][k]);
  }
  const ModelPtr model = make_model(valve);
  const Settled settled = settle(*model, systole, 1);
  check_rest(*model, settled, 1e-5);
  CHECK(settled.stats.contact_pairs > 100);
  MESSAGE(settled.stats.iterations << " iterations, " << settled.stats.wall_s << " s");
}
