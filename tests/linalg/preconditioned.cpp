// Preconditioned conjugate gradients, factors computed in parts, and live steps that reuse an
// earlier factor.
#include <doctest/doctest.h>

#include <mvs/sim.h>

#include <Eigen/Dense>
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <functional>

#include "anatomy/parametric.h"
#include "base/error.h"
#include "linalg/direct_solver.h"
#include "linalg/pcg.h"
#include "linalg/spmv.h"
#include "solve/dynamic/cached_preconditioner.h"
#include "solve/dynamic/preconditioner_key.h"
#include "tests/solve/bench.h"

using namespace mvs::core;
using namespace mvs::core::test;

namespace {

Positions rows_of(const Eigen::VectorXd &v) {
  Positions rows(static_cast<size_t>(v.size() / 3));
  for (size_t i = 0; i < rows.size(); ++i) rows[i] = v.segment<3>(3 * static_cast<Eigen::Index>(i));
  return rows;
}

// 1, base, base squared and so on.
Eigen::VectorXd powers_of(double base) {
  Eigen::VectorXd values(30);
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    values[i] = std::pow(base, static_cast<double>(i));
  }
  return values;
}

// A symmetric matrix with these eigenvalues.
Eigen::MatrixXd with_spectrum(Random &random, const Eigen::VectorXd &values) {
  Eigen::MatrixXd any(values.size(), values.size());
  for (Eigen::Index i = 0; i < any.size(); ++i) any(i) = random(-1, 1);
  const Eigen::MatrixXd q = Eigen::HouseholderQR<Eigen::MatrixXd>(any).householderQ();
  return q * values.asDiagonal() * q.transpose();
}

PcgResult solve(const Eigen::MatrixXd &a, const Positions &b, Positions &x, const PcgGoal &goal) {
  Pcg pcg;
  const auto multiply = [&](const Positions &v, Positions &y) { y = rows_of(a * flat(v)); };
  const auto none_there = [](const Positions &r, Positions &z) { z = r; };
  return pcg.solve(multiply, none_there, b, x, goal);
}

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

// As many iterations as distinct eigenvalues, in exact arithmetic (Hestenes & Stiefel).
TEST_CASE("conjugate_gradients_end_after_as_many_iterations_as_eigenvalues") {
  Random random(11);
  Eigen::VectorXd values(30);
  for (Eigen::Index i = 0; i < values.size(); ++i) values[i] = 1.0 + static_cast<double>(i % 3);
  const Eigen::MatrixXd a = with_spectrum(random, values);
  const Positions b = random.vectors(10, 1);
  Positions x;
  const PcgResult two = solve(a, b, x, {1e-12, 2});
  CHECK(two.iterations == 2);
  CHECK(two.error > 1e-6);
  const PcgResult three = solve(a, b, x, {1e-12, 30});
  CHECK(three.iterations == 3);
  // rounding of thirty sums
  CHECK((a * flat(x) - flat(b)).norm() <= 1e-12 * flat(b).norm());
}

TEST_CASE("conjugate_gradients_report_the_true_residual") {
  Random random(12);
  const Eigen::MatrixXd a = with_spectrum(random, powers_of(1.4));
  const Positions b = random.vectors(10, 1);
  for (const uint32_t most : {1u, 4u, 9u}) {
    Positions x;
    const PcgResult result = solve(a, b, x, {1e-12, most});
    const double left = (a * flat(x) - flat(b)).norm() / flat(b).norm();
    CHECK(result.iterations == most);
    CHECK(result.error == doctest::Approx(left).epsilon(1e-8));
    CHECK(flat(b).dot(flat(x)) > 0);  // downhill
  }
}

// With an exact preconditioner the error after the initial guess is known, and one iteration
// removes it.
TEST_CASE("conjugate_gradients_start_from_a_guess_that_leads_downhill") {
  Random random(16);
  const Eigen::MatrixXd a = with_spectrum(random, powers_of(1.4));
  const Eigen::LLT<Eigen::MatrixXd> exact(a);
  const Positions b = random.vectors(10, 1);
  const auto multiply = [&](const Positions &v, Positions &y) { y = rows_of(a * flat(v)); };
  const auto precondition = [&](const Positions &r, Positions &z) {
    z = rows_of(exact.solve(flat(r)));
  };
  const double size = std::sqrt(flat(b).dot(exact.solve(flat(b))));
  Pcg pcg;
  Positions x;
  const Positions solution = rows_of(0.3 * exact.solve(flat(b)));
  for (const Positions &guess : {solution, random.vectors(10, 1), rows_of(-flat(solution))}) {
    const PcgResult result = pcg.solve(multiply, precondition, b, guess, x, {1e-3, 0});
    const Eigen::VectorXd left = flat(b) - a * flat(x);
    CHECK(flat(b).dot(flat(x)) >= 0);
    // cancellation where nearly all of b is removed
    CHECK(std::abs(result.error - std::sqrt(left.dot(exact.solve(left))) / size) <= 1e-7);
  }
  CHECK(flat(x).isZero(0));  // a guess that leads uphill is discarded
  // one iteration is made although the guess meets the goal, and removes the rest of the error
  CHECK(pcg.solve(multiply, precondition, b, solution, x, {0.9, 9}).iterations == 1);
  CHECK((a * flat(x) - flat(b)).norm() <= 1e-12 * flat(b).norm());
}

TEST_CASE("conjugate_gradients_give_up_a_goal_out_of_reach") {
  Random random(14);
  const Eigen::MatrixXd a = with_spectrum(random, powers_of(2.0));
  const Positions b = random.vectors(10, 1);
  Positions x;
  const PcgResult given_up = solve(a, b, x, {1e-3, 8, 0.1});
  CHECK(given_up.iterations == 2);
  CHECK(given_up.error > 0.1);
  CHECK(solve(a, b, x, {1e-3, 8}).iterations == 8);
}

TEST_CASE("slow_conjugate_gradients_end_with_a_lower_accuracy") {
  Random random(15);
  const Eigen::MatrixXd a = with_spectrum(random, powers_of(1.1));
  const Positions b = random.vectors(10, 1);
  Positions x;
  const uint32_t all = solve(a, b, x, {1e-3, 30}).iterations;
  REQUIRE(all > 6);
  PcgGoal goal{1e-3, 30};
  goal.patience = 4;
  goal.enough = 0.9;
  const PcgResult impatient = solve(a, b, x, goal);
  CHECK(impatient.iterations == 4);
  CHECK(impatient.error <= 0.9);
  goal.enough = 0.1;
  const PcgResult later = solve(a, b, x, goal);
  CHECK(later.iterations > 4);
  CHECK(later.iterations < all);
  CHECK(later.error <= 0.1);
  goal.patience = all;  // a run that reaches its goal first is not affected
  CHECK(solve(a, b, x, goal).iterations == all);
}

TEST_CASE("conjugate_gradients_stop_where_the_matrix_is_not_positive_definite") {
  Random random(13);
  Eigen::VectorXd values = Eigen::VectorXd::Ones(30);
  values[0] = -5;
  const Positions b = random.vectors(10, 1);
  Positions x;
  const PcgResult result = solve(with_spectrum(random, values), b, x, {1e-10, 30});
  CHECK(result.iterations < 30);
  CHECK(result.error > 1e-10);
  CHECK(flat(b).dot(flat(x)) >= 0);
  const PcgResult nothing =
      solve(with_spectrum(random, values), Positions(10, Vec3::Zero()), x, {0, 9});
  CHECK(nothing.error == 0);
  CHECK(largest(x) == 0);
}

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
  matrix.assemble(total_energy, state.x, {1e-3, 0, 64, true}, nullptr, profile);
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
