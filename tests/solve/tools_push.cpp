// Pushing instruments: derivatives, balance, and no instrument passes through tissue.
#include <doctest/doctest.h>

#include <mvs/sim.h>

#include <Eigen/Geometry>
#include <cmath>

#include "energy/forces.h"
#include "energy/grasp.h"
#include "energy/instrument.h"
#include "geometry/intersect.h"
#include "solve/tools/tool_points.h"
#include "solve/tools/tool_stiffness.h"
#include "tests/model/small_valve.h"
#include "tests/solve/bench.h"

using namespace mvs::core;
using namespace mvs::core::test;

namespace {

Tool ball(const Vec3 &at, double radius, double stiffness = 200, double force = 2) {
  Tool tool;
  tool.kind = ToolKind::ball;
  tool.position = at;
  tool.radius = radius;
  tool.stiffness = stiffness;
  tool.max_force = force;
  return tool;
}

Tool rod(const Vec3 &tip, const Vec3 &axis, double radius, double length) {
  Tool tool = ball(tip, radius);
  tool.kind = ToolKind::rod;
  tool.axis = axis.normalized();
  tool.length = length;
  return tool;
}

// The middle of a triangle of the small valve, lifted off its atrial side.
Vec3 above(const Model &model, const std::vector<Vec3> &x, uint32_t triangle, double height) {
  const auto [a, b, c] = model.valve.triangles[triangle];
  const Vec3 n = (x[b] - x[a]).cross(x[c] - x[a]).normalized();
  return (x[a] + x[b] + x[c]) / 3 + height * n;
}

// Checks that on a step along straight lines from `before` to `after` nothing crosses: tools and
// tissue at many times of the step.
void check_way(const Model &model, const State &before, const State &after) {
  constexpr int moments = 10;
  Positions x(before.x.size());
  for (int m = 1; m <= moments; ++m) {
    const double s = static_cast<double>(m) / moments;
    for (size_t i = 0; i < x.size(); ++i) x[i] = (1 - s) * before.x[i] + s * after.x[i];
    for (size_t k = 0; k < after.tools.size(); ++k) {
      Tool tool = after.tools[k];
      for (int p = 0; p < 2; ++p) {
        tool.proxy[p] = (1 - s) * before.tools[k].proxy[p] + s * after.tools[k].proxy[p];
      }
      REQUIRE(clearance(model, x, tool) > 0);
    }
  }
  REQUIRE(find_intersections(after.x, model.valve.triangles).empty());
}

// Moves the hand of the only tool by the distance in each of so many steps of 1 ms.
void push(const Model &model, State &state, const Vec3 &each, int steps) {
  Solver solver(Backend::fastest);
  for (int k = 0; k < steps; ++k) {
    state.tools[0].position += each;
    const State before = state;
    solver.step(model, state, {});
    check_way(model, before, state);
  }
}

}  // namespace

// A hand at 0.15 m/s with steps of 30 ms. If a point moved by 1 mm a step at most, the spring would
// pull the hand back by 0.7 N more in each.
TEST_CASE("an_instrument_far_from_tissue_follows_its_hand_without_a_force") {
  const ModelPtr model = make_model(small_valve());
  for (const bool is_rod : {false, true}) {
    State state = initial_state(*model);
    const Vec3 far = Vec3(0, 0, 0.05);
    add_tool(*model, state, is_rod ? rod(far, Vec3(0, 0, 1), 1e-3, 4e-3) : ball(far, 1e-3));
    Solver solver(Backend::fastest);
    SolveOptions how;
    how.dt = 0.03;
    for (int k = 0; k < 5; ++k) {
      state.tools[0].position += Vec3(0, 0, 4.5e-3);
      solver.step(*model, state, how);
      // the inertia of the instrument, far below what a hand feels
      CHECK(force_of(state, state.tools[0]).force.norm() < 0.01);
    }
  }
}

TEST_CASE("a_pushing_tool_has_the_gradient_and_hessian_of_its_energy") {
  const ModelPtr valve = make_model(small_valve());
  State state = initial_state(*valve);
  // a face touched from inside the funnel, a corner from outside, and edges by a rod across them
  const double near = 0.1 * valve->valve.contact_thickness;
  add_tool(*valve, state, ball(above(*valve, state.x, 40, 1e-3 + near), 1e-3));
  const Vec3 corner = state.x[20];
  const Vec3 outwards(0.95 * corner.head<2>().normalized().x(),
                      0.95 * corner.head<2>().normalized().y(), -0.31);
  add_tool(*valve, state, ball(corner + (0.5e-3 + near) * outwards.normalized(), 0.5e-3));
  const Tri &t = valve->valve.triangles[60];
  const Vec3 along = state.x[t[1]] - state.x[t[0]];
  add_tool(*valve, state,
           rod(above(*valve, state.x, 60, -0.5e-3 - near), along - Vec3(0, 0, 5e-4), 0.5e-3, 4e-3));
  ToolPoints points;
  const Model &with = points.extend(*valve, tool_points(state.tools));
  const State extended = ToolPoints::extended(state);
  Model model = with;
  for (size_t i = 0; i < model.topology.fixed.size(); ++i) model.topology.fixed[i] = 0;
  InstrumentTerm term(model);
  term.bodies().set_tools(state.tools, static_cast<uint32_t>(valve->node_count()));
  term.bodies().prepare(extended.x, extended.x, 1e-4);
  term.collect(extended.x);
  REQUIRE(term.contact_pairs().size() >= 10);
  const auto energy = [&](const Positions &x) {
    term.collect(x);
    return term.energy(x);
  };
  const auto gradient = [&](const Positions &x) {
    Positions g(x.size(), Vec3::Zero());
    term.collect(x);
    CHECK(term.gradient(x, g) == term.energy(x));
    return g;
  };
  const Positions x = extended.x.get();
  // the barrier bends within a tenth of the thickness: differences over 1e-5 of that
  const double h = 1e-9;
  CHECK(farthest(differences(energy, x, h), gradient(x)) <= 1e-5 * largest(gradient(x)));
  HessianAssembler system;
  std::vector<Edge> pairs;
  term.collect(x);
  term.add_pairs(pairs);
  system.set_pattern(model, pairs);
  system.clear();
  CHECK(term.hessian(x, Curvature::exact, system));
  const Eigen::MatrixXd found = dense(system), wanted = differences(gradient, x, h);
  CHECK((found - wanted).norm() <= 1e-5 * wanted.norm());
}

TEST_CASE("a_ball_on_a_membrane_is_carried_by_its_rim") {
  const Model disc = clamped_disc(8, 12e-3, [](Valve &) {});
  State state = initial_state(disc);
  add_tool(disc, state, ball(Vec3(1e-3, 0.5e-3, 4e-3), 3e-3));
  state.tools[0].position.z() = 1e-3;
  for (const SolverKind solver : {SolverKind::newton, SolverKind::implicit_euler}) {
    SolveOptions options;
    options.solver = solver;
    options.residual = 1e-6;
    const Settled settled = settle(disc, state, options);
    CHECK(settled.stats.converged);
    const Tool &tool = settled.state.tools[0];
    CHECK(clearance(disc, settled.state.x, tool) > 0);
    const Vec3 hand = pull(tool_spring(tool, 0, 0), tool.proxy[0]);
    CHECK(hand.z() < -0.01);
    const Positions forces = evaluate_forces(disc, settled.state).total;
    Vec3 rim = Vec3::Zero();
    for (uint32_t i = 0; i < forces.size(); ++i) rim += forces[i];
    // out of balance by at most the residual on each of the free nodes and the ball
    CHECK((rim - hand).norm() <= 1e-6 * static_cast<double>(forces.size() + 1));
  }
}

TEST_CASE("a_ball_and_a_rod_at_1_m_per_s_never_pass_through_a_leaflet") {
  const ModelPtr model = make_model(small_valve());
  State start = initial_state(*model);
  start.load = {2000, 0};
  start = settle(*model, start).state;
  const Vec3 out = above(*model, start.x, 40, 1) - above(*model, start.x, 40, 0);
  for (const int side : {1, -1}) {
    CAPTURE(side);
    const Vec3 way = side * out;
    const Vec3 at = above(*model, start.x, 40, side * 3.5e-3);
    for (const Tool &tool : {ball(at, 2e-3), rod(at, way, 1e-3, 20e-3)}) {
      CAPTURE(tool.kind);
      State state = start;
      add_tool(*model, state, tool);
      push(*model, state, -1e-3 * way, 40);
      const Vec3 behind = state.tools[0].position - state.tools[0].proxy[0];
      // push() checked each step; the tool may slide off the leaflet's side, but is in no tissue
      CHECK(clearance(*model, state.x, state.tools[0]) > 0);
      CHECK(behind.norm() > 5e-3);
      CHECK(farthest(state.x, start.x) > 1e-3);
    }
  }
}

TEST_CASE("a_released_valve_returns_to_its_former_shape") {
  const ModelPtr model = make_model(small_valve());
  State start = initial_state(*model);
  start.load = {2000, 0};
  SolveOptions options;
  options.residual = 1e-8;
  start = settle(*model, start, options).state;
  const Vec3 out = above(*model, start.x, 40, 1) - above(*model, start.x, 40, 0);
  State state = start;
  add_tool(*model, state, ball(above(*model, state.x, 40, 3e-3), 2e-3));
  push(*model, state, -0.5e-3 * out, 6);
  CHECK(farthest(state.x, start.x) > 1e-4);
  remove_tool(state, state.tools[0].id);
  const Settled after = settle(*model, state, options);
  CHECK(after.stats.converged);
  // the same equilibrium, reached from another state, to the residual
  CHECK(farthest(after.state.x, start.x) <= 1e-6);
}

TEST_CASE("a_rod_swung_round_in_one_step_stops_at_the_sheet_and_keeps_its_length") {
  const ModelPtr model = make_model(small_valve());
  State state = initial_state(*model);
  // down the middle of the funnel; then across it
  add_tool(*model, state, rod(Vec3(0, 0, -8e-3), Vec3::UnitZ(), 1e-3, 30e-3));
  Solver solver(Backend::fastest);
  state.tools[0].axis = Vec3::UnitX();
  for (int k = 0; k < 80; ++k) {
    const State before = state;
    solver.step(*model, state, {});
    check_way(*model, before, state);
  }
  const Vec3 &tip = state.tools[0].proxy[0], &handle = state.tools[0].proxy[1];
  // 2 N at most, 1e-4 m of its axial spring
  CHECK((handle - tip).norm() == about(30e-3, 1e-2));
}

TEST_CASE("a_tool_far_away_changes_nothing") {
  const ModelPtr model = make_model(small_valve());
  State state = initial_state(*model);
  state.load = {2000, 0};
  SolveOptions options;
  options.residual = 1e-8;
  const Settled without = settle(*model, state, options);
  CHECK((without.stats.skipped & MVS_SKIPPED_TOOLS) != 0);
  add_tool(*model, state, ball(Vec3(0, 0, 0.1), 5e-3));
  const Settled with = settle(*model, state, options);
  CHECK((with.stats.skipped & MVS_SKIPPED_TOOLS) == 0);
  CHECK(with.state.tools[0] == state.tools[0]);
  CHECK(farthest(with.state.x, without.state.x) <= 1e-7);
}

TEST_CASE("steps_with_tools_are_the_same_with_a_new_solver_as_with_a_used_one") {
  const ModelPtr model = make_model(small_valve());
  State state = initial_state(*model);
  state.load = {2000, 0};
  add_tool(*model, state, ball(above(*model, state.x, 40, 3e-3), 2e-3));
  Solver used(Backend::fastest);
  State fresh = state;
  for (int k = 0; k < 10; ++k) {
    state.tools[0].position *= 0.97;
    fresh.tools[0].position *= 0.97;
    used.step(*model, state, {});
    Solver(Backend::fastest).step(*model, fresh, {});
    REQUIRE(hash_of(*model, state) == hash_of(*model, fresh));
  }
}

TEST_CASE("a_tool_is_refused_where_tissue_leaves_no_room") {
  const ModelPtr model = make_model(small_valve());
  State state = initial_state(*model);
  CHECK_THROWS_WITH(add_tool(*model, state, ball(above(*model, state.x, 40, 1e-3), 2e-3)),
                    doctest::Contains("would lie in leaflet tissue"));
  CHECK_THROWS_WITH(
      add_tool(*model, state,
               rod(above(*model, state.x, 40, 5e-3),
                   above(*model, state.x, 40, -1) - above(*model, state.x, 40, 0), 0.5e-3, 20e-3)),
      doctest::Contains("would lie in leaflet tissue"));
  CHECK(state.tools.empty());
}

TEST_CASE("the_explicit_solver_refuses_to_push") {
  const ModelPtr model = make_model(small_valve());
  State state = initial_state(*model);
  add_tool(*model, state, ball(Vec3(0, 0, 0.02), 2e-3));
  SolveOptions options;
  options.solver = SolverKind::explicit_euler;
  Solver solver(Backend::fastest);
  CHECK_THROWS_WITH(solver.step(*model, state, options), doctest::Contains("explicit solver"));
}
