// Static closure: converges, reports convergence truthfully, and can be cancelled.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "energy/forces.h"
#include "geometry/intersect.h"
#include "model/checks/check.h"
#include "tests/model/real_valves.h"
#include "tests/solve/bench.h"
#include "tests/solve/moving_valve.h"

using namespace mvs::core;
using namespace mvs::core::test;

namespace {

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
  CHECK(std::abs(residual_of(model, settled.state) - settled.stats.residual) < 1e-12);
  CHECK(find_intersections(settled.state.x, model.valve.triangles).empty());
  CHECK(largest(settled.state.v) == 0);
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
