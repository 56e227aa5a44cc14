// Grasps: the spring of the hand and the tissue that it holds.
#include <doctest/doctest.h>

#include <cmath>

#include "energy/forces.h"
#include "energy/grasp.h"
#include "tests/model/small_valve.h"
#include "tests/solve/bench.h"

using namespace mvs::core;
using namespace mvs::core::test;

namespace {

Tool grasp(uint32_t node, const Vec3 &hand, double stiffness = 200, double force = 5) {
  Tool tool;
  tool.kind = ToolKind::grasp;
  tool.node = node;
  tool.position = hand;
  tool.stiffness = stiffness;
  tool.max_force = force;
  return tool;
}

SolveOptions to_rest(double residual, SolverKind solver = SolverKind::newton) {
  SolveOptions options;
  options.solver = solver;
  options.residual = residual;
  return options;
}

// Two chordae in one line from fixed ends to a free node between them, both 10 % longer than at
// rest: stiffness E A / L0 each along it.
Model two_springs() {
  Valve valve;
  valve.rest = {Vec3(-0.011, 0, 0), Vec3(0, 0, 0), Vec3(0.011, 0, 0)};
  Chord chord;
  chord.rest_length = 0.010;
  chord.area = 1e-7;
  chord.young = 1e6;
  for (uint32_t k = 0; k < 2; ++k) {
    chord.a = 2 * k;
    chord.b = 1;
    valve.chords.push_back(chord);
  }
  return model_of_sheet(valve, {0, 2});
}
constexpr double spring = 1e6 * 1e-7 / 0.010;  // N/m

}  // namespace

TEST_CASE("a_grasp_has_the_gradient_and_hessian_of_its_energy") {
  const Model model = model_of_sheet(small_valve(), {});
  const State state = initial_state(model);
  Random random(7);
  GraspTerm term;
  std::vector<Tool> tools;
  // within the largest force of the hand and beyond it
  for (uint32_t k = 0; k < 6; ++k) {
    tools.push_back(grasp(7 * k, state.x[7 * k] + random.vector(5e-3), 150, k < 3 ? 10 : 0.1));
  }
  term.set_tools(tools, 0);
  const auto energy = [&](const Positions &x) { return term.energy(x); };
  const auto gradient = [&](const Positions &x) {
    Positions g(x.size(), Vec3::Zero());
    CHECK(term.gradient(x, g) == term.energy(x));
    return g;
  };
  // differences over 1e-6 m of springs some mm long
  const Positions x = state.x.get();
  CHECK(farthest(differences(energy, x, 1e-6), gradient(x)) <= 1e-7 * largest(gradient(x)));
  HessianAssembler system;
  system.set_pattern(model, {});
  system.clear();
  term.hessian(x, system);
  const Eigen::MatrixXd found = dense(system), wanted = differences(gradient, x, 1e-6);
  CHECK((found - wanted).norm() <= 1e-6 * wanted.norm());
}

TEST_CASE("a_held_node_between_two_springs_moves_to_the_balance_of_three") {
  const Model model = two_springs();
  for (const double hand : {0.2e-3, 0.5e-3}) {
    State state = initial_state(model);
    state.tools = {grasp(1, Vec3(hand, 0, 0), 30)};
    const Settled settled = settle(model, state, to_rest(1e-9));
    CHECK(settled.stats.converged);
    CHECK(settled.state.x[1].x() == about(30 * hand / (2 * spring + 30), 1e-6));
    // beyond its largest force the hand yields at that force
    state.tools = {grasp(1, Vec3(hand, 0, 0), 30, 1e-3)};
    CHECK(settle(model, state, to_rest(1e-9)).state.x[1].x() == about(1e-3 / (2 * spring), 1e-6));
  }
}

TEST_CASE("the_held_tissue_pulls_back_with_the_force_of_the_hand") {
  const ModelPtr model = make_model(small_valve());
  const uint32_t node = 3 * small_segments + 3;
  State start = initial_state(*model);
  start.load = {2000, 0};
  start.tools = {grasp(node, start.x[node] + Vec3(0, 0, 4e-3))};
  for (const SolverKind solver : {SolverKind::newton, SolverKind::implicit_euler}) {
    const Settled settled = settle(*model, start, to_rest(1e-6, solver));
    CHECK(settled.stats.converged);
    State without = settled.state;
    without.tools.clear();
    const Vec3 tissue = evaluate_forces(*model, without).total[node];
    const Vec3 hand = pull(tool_spring(start.tools[0], 0, node), settled.state.x[node]);
    CHECK(hand.norm() > 0.01);
    CHECK((hand + tissue).norm() <= 1e-6);  // the residual
    CHECK(evaluate_forces(*model, settled.state).total[node].norm() <= 1e-6);
  }
}

TEST_CASE("a_pull_of_50_mm_in_one_step_is_limited_to_its_largest_force_and_recovers") {
  const ModelPtr model = make_model(small_valve());
  const uint32_t node = 3 * small_segments + 3;
  State state = initial_state(*model);
  state.load = {2000, 0};
  const Settled before = settle(*model, state, to_rest(1e-8));
  state = before.state;
  // through the other leaflet
  state.tools = {grasp(node, -state.x[node].normalized() * 0.05, 200, 2)};
  Solver solver(Backend::fastest);
  for (int k = 0; k < 100; ++k) {
    solver.step(*model, state, {});
    REQUIRE(pull(tool_spring(state.tools[0], 0, node), state.x[node]).norm() <= 2 * (1 + 1e-12));
  }
  CHECK(farthest(state.x, before.state.x) > 2e-3);
  state.tools.clear();
  const Settled after = settle(*model, state, to_rest(1e-8));
  CHECK(after.stats.converged);
  // the same equilibrium, reached from another state, to the residual
  CHECK(farthest(after.state.x, before.state.x) <= 1e-6);
}

TEST_CASE("a_hand_rotated_with_the_valve_has_the_same_effect") {
  const Motion motion = some_motion();
  Valve turned = small_valve();
  for (CowVector<Vec3> *places : {&turned.rest, &turned.open, &turned.loaded}) {
    for (Vec3 &p : *places) p = motion(p);
  }
  const uint32_t node = 3 * small_segments + 5;
  Positions x[2];
  for (int k = 0; k < 2; ++k) {
    const ModelPtr model = make_model(k == 0 ? small_valve() : turned);
    State state = initial_state(*model);
    state.load = {1000, 0};
    const Vec3 hand = small_valve().rest[node] + Vec3(1e-3, 2e-3, 3e-3);
    state.tools = {grasp(node, k == 0 ? hand : motion(hand))};
    x[k] = settle(*model, state, to_rest(1e-8)).state.x;
  }
  // forces to 1e-8 N on the softest modes of some N/m
  CHECK(farthest(motion(x[0]), x[1]) <= 1e-7);
}

TEST_CASE("a_state_whose_tools_were_removed_keeps_only_the_next_id") {
  const ModelPtr model = make_model(small_valve());
  State state = initial_state(*model);
  const auto before = hash_of(*model, state);
  const Id id = add_tool(*model, state, grasp(3 * small_segments, Vec3(0, 0, 0)));
  CHECK(hash_of(*model, state) != before);
  remove_tool(state, id);
  // an id was given: the next one will be another
  CHECK(hash_of(*model, state) != before);
  CHECK(add_tool(*model, state, grasp(3 * small_segments, Vec3(0, 0, 0))) == id + 1);
}
