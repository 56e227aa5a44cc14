// Live steps that reuse an earlier factor, and the keys of factors in the solver cache.
#include <doctest/doctest.h>

#include <mvs/sim.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <functional>

#include "anatomy/parametric.h"
#include "base/error.h"
#include "linalg/direct_solver.h"
#include "linalg/spmv.h"
#include "solve/dynamic/cached_preconditioner.h"
#include "solve/dynamic/preconditioner_key.h"
#include "tests/solve/bench.h"

using namespace mvs::core;
using namespace mvs::core::test;

namespace {

ModelPtr a_valve() {
  mvs_parametric_desc desc = {};
  desc.shape = MVS_SHAPE_FOUNDING;
  desc.struct_size = sizeof desc;
  desc.vertices = 200;
  return make_model(make_parametric_valve(desc));
}

// Closed, then pulsing: always in motion.
void pulse(State &state, int step) {
  state.load.pressure = MVS_SYSTOLE_PA * (0.9 + 0.1 * std::cos(0.05 * step));
}

}  // namespace

// A factor computed in parts equals the factor.
TEST_CASE("parts_of_a_factor_give_its_bits") {
  const ModelPtr model = a_valve();
  State state = closed(*model);
  TotalEnergy total_energy(*model);
  Profile profile{};
  Positions g;
  total_energy.set_pressure(state.load.pressure);
  total_energy.prepare(state.x, state.x, 0, profile);
  total_energy.gradient(state.x, g, profile);
  StepMatrix matrix(*model);
  matrix.assemble(total_energy, state.x, {1e-3, 0, 64, true, true}, nullptr, profile);
  for (const Backend backend : {Backend::block, Backend::eigen}) {
    CAPTURE(backend);
    CachedPreconditioner whole(*model, make_direct_solver(backend)),
        parts(*model, make_direct_solver(backend));
    const PreconditionerKey place{state.x, {}, state.load.pressure, 1e-3, 0, 0};
    whole.copy(matrix, place, nullptr);
    parts.copy(matrix, place, nullptr);
    REQUIRE(whole.factorise());
    for (uint32_t part = 0; part < whole.parts(); ++part) {
      CHECK(!parts.is_of(place, whole.parts()));
      REQUIRE(parts.factorise_part(part));
      REQUIRE(parts.factorise_part(0));  // finished parts remain
    }
    CHECK(parts.is_of(place, whole.parts()));
    Positions rows(matrix.size()), x, y, back;
    for (size_t r = 0; r < rows.size(); ++r) rows[r] = g[matrix.node(static_cast<uint32_t>(r))];
    rows[3] = Vec3(1e-3, -2e-3, 3e-3);
    whole.solve(rows, x);
    parts.solve(rows, y);
    CHECK(std::memcmp(x.data(), y.data(), x.size() * sizeof(Vec3)) == 0);
    // and of the matrix whose products are taken
    BlockSpmv().multiply(matrix.blocks(), x, back);
    for (size_t r = 0; r < rows.size(); ++r) back[r] -= rows[r];
    CHECK(largest(back) <= 1e-9 * largest(rows));  // its condition times rounding
  }
}

// Compared with a step that factorises its own matrix, at the same state.
TEST_CASE("an_earlier_factor_preconditions_within_its_tolerance") {
  const ModelPtr model = a_valve();
  State state = closed(*model);
  Solver solver(Backend::fastest), direct(Backend::fastest);
  uint32_t served = 0, whole = 0;
  for (int k = 0; k < 200; ++k) {
    if (k % 4 == 0) pulse(state, k);
    State alone = state;
    alone.drop_cache();
    const State before = state;
    const SolveStats stats = solver.step(*model, state, {});
    const SolveStats exact = direct.step(*model, alone, {});
    if ((exact.skipped & MVS_SKIPPED_STEP) != 0) continue;
    CHECK(exact.factorisations > 0);
    whole += stats.factorisations;
    served += (stats.skipped & MVS_SKIPPED_FACTOR) != 0;
    if (stats.lowered != 0 || exact.lowered != 0) continue;
    double far = 0, off = 0;
    for (size_t i = 0; i < state.x.size(); ++i) {
      far = std::max(far, (alone.x.get()[i] - before.x.get()[i]).norm());
      off = std::max(off, (alone.x.get()[i] - state.x.get()[i]).norm());
    }
    // 2 % of the residual at most, in the norm of the factor; in the longest displacement, step
    // limiting included, that was up to 6 %
    CHECK(off <= 0.1 * far);
  }
  CHECK(served > 100);
  CHECK(whole < 40);
}

TEST_CASE("a_waking_valve_computes_no_factor") {
  const ModelPtr model = a_valve();
  State state = closed(*model);
  Solver solver(Backend::fastest);
  state.load.pressure *= 0.95;
  bool asleep = false;
  for (int k = 0; k < 2000 && !asleep; ++k) {
    asleep = (solver.step(*model, state, {}).skipped & MVS_SKIPPED_STEP) != 0;
  }
  REQUIRE(asleep);
  CHECK(!state.cache.empty());
  state.load.pressure *= 1.01;
  const SolveStats stats = solver.step(*model, state, {});
  CHECK((stats.skipped & MVS_SKIPPED_STEP) == 0);
  CHECK(stats.factorisations == 0);
}

TEST_CASE("a_valve_that_was_settled_has_no_solver_cache") {
  const ModelPtr model = a_valve();
  State state = closed(*model);
  Solver solver(Backend::fastest);
  state.load.pressure *= 0.95;
  for (int k = 0; k < 5; ++k) solver.step(*model, state, {});
  CHECK(!state.cache.empty());
  SUBCASE("settled") {
    solver.settle(*model, state, {}, {});
  }
  SUBCASE("another step in time") {
    SolveOptions how;
    how.solver = SolverKind::explicit_euler;
    solver.step(*model, state, how);
  }
  CHECK(state.cache.empty());
}

// A restored state may be earlier or later, with a factor half finished.
TEST_CASE("restoring_earlier_and_later_states_changes_no_bit") {
  const ModelPtr model = a_valve();
  State state = closed(*model);
  Solver solver(Backend::fastest);
  std::vector<State> states;
  for (int k = 0; k < 40; ++k) {
    if (k % 4 == 0) pulse(state, 5 * k);
    states.push_back(state);
    solver.step(*model, state, {});
  }
  const auto same = [](const State &a, const State &b) {
    return std::memcmp(a.x.data(), b.x.data(), a.x.size() * sizeof(Vec3)) == 0 &&
           a.cache.version == b.cache.version && a.cache.counter == b.cache.counter &&
           std::equal(a.cache.data.begin(), a.cache.data.end(), b.cache.data.begin(),
                      b.cache.data.end(), [](double left, double right) {
                        return std::bit_cast<uint64_t>(left) == std::bit_cast<uint64_t>(right);
                      });
  };
  for (const int from : {30, 3, 21, 22, 8, 36, 20}) {
    State again = states[from];
    for (int k = from; k < from + 3; ++k) {
      again.load = states[k].load;
      solver.step(*model, again, {});
      State told = states[k + 1];
      REQUIRE(same(again, told));
    }
  }
}

namespace {

mvs_result outcome(const ModelState &current) {
  try {
    check_solver_cache(current);
    return MVS_OK;
  } catch (const Error &error) {
    CHECK(error.what()[0] != '\0');
    return error.code;
  }
}

// The same state with the numbers of its cache changed.
ModelState with_numbers(ModelState current,
                        const std::function<void(std::vector<double> &)> &edit) {
  edit(current.state.cache.data.edit());
  return current;
}

// A valve in motion whose solver cache has both keys, one of them with a ball and a grasp.
ModelState with_both_keys() {
  const ModelPtr model = a_valve();
  State state = closed(*model);
  Tool ball, grasp;
  ball.kind = ToolKind::ball;
  ball.radius = ball.stiffness = ball.max_force = grasp.stiffness = grasp.max_force = 1;
  grasp.kind = ToolKind::grasp;
  for (grasp.node = 0; model->topology.fixed[grasp.node];) ++grasp.node;
  PreconditionerKeys keys;
  keys.active = {state.x, {}, 12e3, 1e-3, 0, 9};
  keys.pending = {state.x, {ball, grasp}, 13e3, 1e-3, 0, 2};
  keys.pending.x.push_back(Vec3(1, 2, 3));
  CowVector<double> data;
  state.cache = pack(keys, data);
  return {model, state};
}

}  // namespace

TEST_CASE("keys_come_out_of_a_solver_cache_as_they_went_in") {
  const ModelState current = with_both_keys();
  const size_t nodes = current.model->node_count();
  const PreconditionerKeys keys = unpack(current.state.cache, *current.model, nodes);
  CHECK(keys.active.age == 9);
  CHECK(keys.pending.age == 2);
  CHECK(keys.pending.tools.size() == 2);
  CHECK(keys.pending.x.size() == nodes + 1);
  CowVector<double> data;
  CHECK(pack(keys, data) == current.state.cache);
  CHECK(pack({}, data).empty());
}

TEST_CASE("a_damaged_solver_cache_is_refused") {
  const ModelState good = with_both_keys();
  CHECK(outcome(good) == MVS_OK);
  using Numbers = std::vector<double>;
  const size_t tools_at = 5 + 3 * good.model->node_count() + 5;
  for (const std::function<void(Numbers &)> &edit :
       {std::function<void(Numbers &)>([](Numbers &n) { n.pop_back(); }),
        std::function<void(Numbers &)>([](Numbers &n) { n.push_back(0); }),
        std::function<void(Numbers &)>([](Numbers &n) { n.resize(7); }),
        std::function<void(Numbers &)>([](Numbers &n) { n[0] = 1e15; }),
        std::function<void(Numbers &)>([](Numbers &n) { n[0] = -1; }),
        std::function<void(Numbers &)>([](Numbers &n) { n[0] += 0.5; }),
        std::function<void(Numbers &)>([](Numbers &n) { n[1] = 1e18; }),
        std::function<void(Numbers &)>([](Numbers &n) { n[1] = 1; }),
        std::function<void(Numbers &)>([](Numbers &n) { n[9] = NAN; }),
        std::function<void(Numbers &)>([&](Numbers &n) { n[tools_at + 1] = 9; }),
        std::function<void(Numbers &)>([&](Numbers &n) { n[tools_at + 1] = 0; })}) {
    CHECK(outcome(with_numbers(good, edit)) == MVS_E_FORMAT);
  }
  ModelState other = good;
  ++other.state.cache.version;
  CHECK(outcome(other) == MVS_E_VERSION);
  // more parts of a factor than there are
  other = good;
  for (const uint64_t parts :
       {uint64_t{CachedPreconditioner::parts_for(*good.model)} + 1, uint64_t{UINT32_MAX}}) {
    other.state.cache.counter = parts << 32;
    CHECK(outcome(other) == MVS_E_FORMAT);
    Solver solver(Backend::fastest);
    CHECK_THROWS_AS(solver.step(*other.model, other.state, {}), Error);
  }
}

// Keys with tools that the state no longer has are valid, but serve no step.
TEST_CASE("keys_that_do_not_fit_the_state_are_left_out") {
  ModelState current = with_both_keys();
  Solver solver(Backend::fastest);
  solver.step(*current.model, current.state, {});
  const SolverCache &cache = current.state.cache;
  REQUIRE(!cache.empty());
  CHECK(unpack(cache, *current.model, current.model->node_count()).pending.tools.empty());
}
