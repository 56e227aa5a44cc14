// The live step: bits independent of the solver object, bounded by a budget, asleep at rest.
#include <doctest/doctest.h>

#include <mvs/sim.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "anatomy/parametric.h"
#include "geometry/intersect.h"
#include "solve/dynamic/cached_preconditioner.h"
#include "solve/dynamic/implicit_euler.h"
#include "tests/founding.h"
#include "tests/solve/bench.h"

using namespace mvs::core;
using namespace mvs::core::test;

namespace {

constexpr double systole = MVS_SYSTOLE_PA;

ModelPtr parametric(uint32_t vertices, double annulus_contraction = 0) {
  mvs_parametric_desc desc = founding_valve();
  desc.vertices = vertices;
  desc.annulus_contraction = annulus_contraction;
  return make_model(make_parametric_valve(desc));
}

ModelPtr small_parametric() {
  return parametric(200, 0.9);
}

// The leaflets part and meet again.
void beat(State &state, int step) {
  state.load.pressure = systole * (0.55 + 0.45 * std::cos(0.1 * step));
}

bool same(const Positions &a, const Positions &b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(Vec3)) == 0;
}

bool same(const State &a, const State &b) {
  return same(a.x.get(), b.x.get()) && same(a.v.get(), b.v.get()) && a.steps == b.steps;
}

// The next steps from a state by a solver that has taken others before, and by a new one.
void check_steps_of_a_new_solver(const Model &model, const State &state, Solver &used,
                                 Backend backend, int steps) {
  State other = state, ahead = state;
  Solver fresh(backend);
  for (int j = 0; j < steps; ++j) {
    fresh.step(model, other, {});
    used.step(model, ahead, {});
    REQUIRE(same(other, ahead));
  }
}

}  // namespace

// Data that a solver keeps (pattern, candidates, forces) have no effect: a solver that has seen
// contact appear and vanish and a new solver take the same steps.
TEST_CASE("steps_under_a_changing_load_have_the_same_bits_from_any_state") {
  const ModelPtr model = small_parametric();
  for (const Backend backend : {Backend::block, Backend::eigen}) {
    CAPTURE(backend);
    State state = closed(*model);
    Solver one(backend);
    for (int k = 0; k < 120; ++k) {
      if (k % 4 == 0) beat(state, k);
      if (k % 40 == 20) check_steps_of_a_new_solver(*model, state, one, backend, 15);
      one.step(*model, state, {});
    }
  }
}

// The same for a sheet with another order, factors in 16 bits made in more parts, and a schedule of
// its own.
TEST_CASE("steps_of_a_large_sheet_have_the_same_bits_from_any_state") {
  const ModelPtr model = parametric(4300);
  REQUIRE(CachedPreconditioner::is_large(*model));
  State state = initial_state(*model);
  state.load = {systole, 1};
  Solver one(Backend::fastest);
  uint32_t factors = 0;
  for (int k = 0; k < 24; ++k) {
    if (k % 8 == 5) check_steps_of_a_new_solver(*model, state, one, Backend::fastest, 3);
    factors += one.step(*model, state, {}).factorisations;
  }
  CHECK(factors > 1);
}

TEST_CASE("a_short_budget_lowers_accuracy_and_reports_it_and_keeps_safety") {
  const ModelPtr model = small_parametric();
  for (const uint32_t budget : {4u, 5u, 8u, 64u}) {
    CAPTURE(budget);
    State state = initial_state(*model);
    state.load = {systole, 1};
    SolveOptions options;
    options.budget = budget;
    Solver solver(Backend::fastest);
    uint32_t lowered = 0;
    for (int k = 0; k < 150; ++k) {
      const SolveStats stats = solver.step(*model, state, options);
      lowered |= stats.lowered;
      // matrix, factors and energies, and the forces before the first step
      REQUIRE(stats.work.passes + stats.factorisations <= budget + 1);
      REQUIRE(std::isfinite(stats.residual));
      if (k % 10 == 0) REQUIRE(find_intersections(state.x, model->valve.triangles).empty());
    }
    if (budget == 4) CHECK(lowered != 0);
    // contact and the longest displacement hold nodes back at any budget
    if (budget == 64) CHECK((lowered & MVS_LOWERED_LINEAR) == 0);
  }
}

TEST_CASE("a_step_that_holds_nodes_back_says_so") {
  const ModelPtr model = small_parametric();
  // 16 kPa accelerate 1 mg/mm2 by 16 km/s2: 16 nm in 1 us, and 16 mm in 1 ms, more than a step
  // allows
  for (const double dt : {1e-6, 1e-3}) {
    CAPTURE(dt);
    State state = initial_state(*model);
    state.load = {systole, 1};
    SolveOptions options;
    options.dt = dt;
    Solver solver(Backend::fastest);
    const SolveStats stats = solver.step(*model, state, options);
    CHECK((stats.lowered & MVS_LOWERED_STEP) == (dt > 1e-4 ? MVS_LOWERED_STEP : 0));
  }
}

// A disc has no free edge, so its energy is defined, and the energy that a step creates can be
// measured.
TEST_CASE("a_short_budget_creates_no_energy") {
  const Model disc = clamped_disc(5, 12e-3, [](Valve &) {});
  for (const uint32_t budget : {4u, 6u}) {
    State state = initial_state(disc);
    state.load.pressure = systole;
    SolveOptions options;
    options.budget = budget;
    options.dt = 5e-3;
    Solver solver(Backend::fastest);
    double before = total_energy(disc, state), scale = std::abs(before);
    for (int k = 0; k < 60; ++k) {
      solver.step(disc, state, options);
      const double after = total_energy(disc, state);
      scale = std::max(scale, std::abs(after));
      // rounding of sums of some hundred terms
      REQUIRE(after <= before + 1e-11 * scale);
      before = after;
    }
  }
}

TEST_CASE("a_valve_at_rest_sleeps_until_something_changes") {
  const ModelPtr model = small_parametric();
  State state = closed(*model);
  Solver solver(Backend::fastest);
  const State before = state;
  for (int k = 0; k < 3; ++k) {
    const SolveStats stats = solver.step(*model, state, {});
    CHECK((stats.skipped & MVS_SKIPPED_STEP) != 0);
    CHECK(stats.factorisations == 0);
    CHECK(stats.residual <= rest_tolerance_of(state.load));
  }
  CHECK(state.x == before.x);
  CHECK(state.steps == 3);
  SUBCASE("the load") {
    state.load.pressure *= 0.99;
  }
  SUBCASE("the boundary") {
    state.load.boundary_fraction = 0.99;
  }
  SUBCASE("a position") {
    state.x[60].z() += 1e-5;
  }
  SUBCASE("a velocity") {
    const auto node = static_cast<size_t>(
        std::find(model->topology.fixed.begin(), model->topology.fixed.end(), 0) -
        model->topology.fixed.begin());
    state.v[node].z() = 0.1;
  }
  CHECK((solver.step(*model, state, {}).skipped & MVS_SKIPPED_STEP) == 0);
}

// The tolerance follows the load: under a small pressure a valve that still moves does not sleep.
TEST_CASE("an_unloaded_valve_rests_only_without_forces") {
  CHECK(rest_tolerance_of({0, 0}) == about(1e-9, 1e-9));
  CHECK(rest_tolerance_of({systole, 1}) >= 1e-5);
  CHECK(rest_tolerance_of({-systole, 1}) == rest_tolerance_of({systole, 1}));
  CHECK(rest_tolerance_of({10 * systole, 1}) == rest_tolerance_of({systole, 1}));
}

// In steps of 20 ms nodes would move farther than any node may. Limited node by node such a step
// leads uphill, and a valve that takes no part of it would never move.
TEST_CASE("a_valve_out_of_balance_keeps_moving") {
  const ModelPtr model = parametric(425);
  State state = closed(*model);
  Solver solver(Backend::fastest);
  SolveOptions options;
  options.dt = 20e-3;
  for (const double pressure : {0.0, systole}) {
    state.load.pressure = pressure;
    for (int k = 0; k < 100; ++k) {
      const State before = state;
      const SolveStats stats = solver.step(*model, state, options);
      CAPTURE(pressure);
      CAPTURE(k);
      const bool rests = stats.residual <= rest_tolerance_of(state.load);
      CHECK((rests || !same(before.x.get(), state.x.get())));
    }
  }
}
