// Convex tools: poses, the same forces as a ball, settles and steps, and where they are refused.
#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "energy/forces.h"
#include "solve/tools/tool_stiffness.h"
#include "tests/model/small_valve.h"
#include "tests/solve/bench.h"
#include "tests/solve/convex_tools.h"

using namespace mvs::core;
using namespace mvs::core::test;

TEST_CASE("a_pose_is_that_of_its_frame") {
  Random random(2);
  for (int k = 0; k < 100; ++k) {
    const Quaternion q = {random(-1, 1), random(-1, 1), random(-1, 1), random(-1, 1)};
    const Eigen::Quaterniond wanted = Eigen::Quaterniond(q[0], q[1], q[2], q[3]).normalized();
    const Vec3 rodrigues = rodrigues_of(q);
    CHECK(rodrigues.norm() <= 1 + 1e-15);
    CHECK((rotation_of(rodrigues) - wanted.toRotationMatrix()).norm() <= 1e-14);
    Tool tool = convex_at(random.vector(1e-2), {ball_body(3e-3)});
    tool.axis = rodrigues;
    // a uniform stretch of 2 % does not turn it
    std::array<Vec3, frame_points> points;
    for (uint32_t p = 0; p < frame_points; ++p)
      points[p] = tool.position + 1.02 * (tool.target(p) - tool.position);
    const FramePose pose = pose_of(points, tool.length);
    CHECK((pose.position - tool.position).norm() <= 1e-16);
    CHECK((pose.rotation - wanted.toRotationMatrix()).norm() <= 1e-13);
    const Quaternion back = quaternion_of(pose.rotation);
    const double same =
        back[0] * wanted.w() + back[1] * wanted.x() + back[2] * wanted.y() + back[3] * wanted.z();
    CHECK(std::abs(same) == about(1, 1e-14));
  }
}

TEST_CASE("a_body_of_one_point_feels_as_a_ball_of_its_radius") {
  const Model disc = clamped_disc(8, 12e-3, [](Valve &) {});
  SolveOptions options;
  options.residual = 1e-8;
  std::array<ToolForce, 2> force;
  std::array<double, 2> stiffness;
  for (int k = 0; k < 2; ++k) {
    State state = initial_state(disc);
    const Vec3 at(1e-3, 0.5e-3, 4e-3);
    Tool tool = convex_at(at, {ball_body(3e-3)});
    if (k == 1) {
      tool = Tool();
      tool.kind = ToolKind::ball;
      tool.position = at;
      tool.radius = 3e-3;
      tool.stiffness = 200;
      tool.max_force = 2;
    }
    add_tool(disc, state, tool);
    state.tools[0].position.z() = -3e-3;
    const Settled settled = settle(disc, state, options);
    CHECK(settled.stats.converged);
    force[k] = force_of(settled.state, settled.state.tools[0]);
    ToolFeel feel(Backend::fastest);
    stiffness[k] = feel.stiffness(disc, settled.state, settled.state.tools[0])(2, 2);
  }
  CHECK(force[1].force.z() > 0.05);
  // issue 24 wants 0.1 %; both are the same equilibrium up to the residual of some 200 nodes
  CHECK((force[0].force - force[1].force).norm() <= 1e-4 * force[1].force.norm());
  CHECK(stiffness[0] == about(stiffness[1], 1e-3));
}

TEST_CASE("polyhedral_balls_converge_to_the_ball_at_second_order") {
  const Model disc = clamped_disc(8, 12e-3, [](Valve &) {});
  // the mean over a few orientations: whether a corner or a facet is at the front differs by as
  // much as the error itself
  const auto lift = [&](const ToolBody &body) {
    Random random(9);
    double sum = 0;
    for (int k = 0; k < 6; ++k) {
      State state = initial_state(disc);
      SolveOptions options;
      options.residual = 1e-8;
      Tool tool = convex_at(Vec3(1e-3, 0.5e-3, 4e-3), {body});
      tool.axis = random.vector(0.5);
      // little more than the disc bears: the strength of short-range barriers grows with it
      tool.max_force = 0.2;
      add_tool(disc, state, tool);
      state.tools[0].position.z() = -3e-3;
      const Settled settled = settle(disc, state, options);
      const double force = force_of(settled.state, settled.state.tools[0]).force.norm();
      CHECK(settled.stats.converged);
      sum += force / 6;
    }
    return sum;
  };
  const double ball = lift(ball_body(3e-3));
  std::array<double, 3> force;
  const std::array<uint32_t, 3> counts = {64, 250, 1000};
  for (int k = 0; k < 3; ++k) {
    force[k] = lift(polyhedral_ball(3e-3, counts[k]));
    MESSAGE(counts[k] << " vertices: " << 100 * (force[k] / ball - 1) << " %");
  }
  // an error of a / N, with the squared distance of neighbours: differences of 1/64 - 1/250 and
  // 1/250 - 1/1000, times a
  const double wanted = (1.0 / 64 - 1.0 / 250) / (1.0 / 250 - 1.0 / 1000);
  CHECK((force[1] - force[0]) / (force[2] - force[1]) == about(wanted, 0.1));
  // the limit for N to infinity: that of the ball less 0.1 %, the frame's elasticity where a force
  // acts on its surface and not at the hand, and more by the smoothed distance, which a hull of
  // many corners has and the ball has not: it stands off by up to 10 um more, a twentieth of the
  // range of the barrier, and the spring of the hand has 200 N/m
  const double limit = force[2] + (force[2] - force[1]) / 3;
  CHECK(std::abs(limit - ball) < 1.5e-3 * ball + 200 * 10e-6);
}

TEST_CASE("a_stretched_frame_keeps_its_form_to_a_per_cent") {
  const Model disc = clamped_disc(8, 12e-3, [](Valve &valve) {
    valve.leaflets.resize(1);
    valve.leaflets[0].thickness = 10e-3;
  });
  State state = initial_state(disc);
  // pushes with its end, 10 mm from the hand
  Tool tool = convex_at(Vec3(0, 0, 14e-3), {capsule_body(Vec3(0, 0, 1), 20e-3, 2e-3)});
  tool.max_force = 5;
  tool.stiffness = 5000;
  add_tool(disc, state, tool);
  state.tools[0].position.z() = 7e-3;
  const Settled settled = settle(disc, state);
  CHECK(settled.stats.converged);
  const Tool &after = settled.state.tools[0];
  const double force = force_of(settled.state, after).force.z(), edge = frame_edge(after.length);
  CHECK(force > 0.5);
  for (uint32_t k = 1; k < frame_points; ++k) {
    for (uint32_t l = 0; l < k; ++l) {
      const double stretch = (after.proxy[k] - after.proxy[l]).norm() / edge - 1;
      CHECK(std::abs(stretch) <= 0.01 * force / 5);
    }
  }
}

TEST_CASE("steps_with_a_convex_tool_are_the_same_with_a_new_solver_as_with_a_used_one") {
  const ModelPtr model = make_model(small_valve());
  State state = initial_state(*model);
  state.load = {2000, 0};
  const Place at = place_above(*model, state.x, 40, 3e-3);
  add_tool(*model, state, convex_at(at.point, {cone_body(at.normal, 4e-3, 2e-3, 0.5e-3)}));
  Solver used(Backend::fastest);
  State fresh = state;
  for (int k = 0; k < 10; ++k) {
    for (State *s : {&state, &fresh}) {
      s->tools[0].position *= 0.97;
      s->tools[0].axis.x() += 0.01;
    }
    used.step(*model, state, {});
    Solver(Backend::fastest).step(*model, fresh, {});
    REQUIRE(hash_of(*model, state) == hash_of(*model, fresh));
  }
}

namespace {

// Moves the hand of the only tool in each of so many steps; returns in how many of them neither
// tissue nor tool moved.
int steps_without_motion(const Model &model, State &state, const Vec3 &each, int steps) {
  Solver solver(Backend::fastest);
  int still = 0;
  for (int k = 0; k < steps; ++k) {
    state.tools[0].position += each;
    const State before = state;
    solver.step(model, state, {});
    double moved = 0;
    for (uint32_t p = 0; p < frame_points; ++p)
      moved = std::max(moved, (state.tools[0].proxy[p] - before.tools[0].proxy[p]).norm());
    for (size_t i = 0; i < state.x.size(); ++i)
      moved = std::max(moved, (state.x[i] - before.x[i]).norm());
    // a ten-thousandth of the way of the hand
    if (moved < 1e-4 * each.norm()) ++still;
  }
  return still;
}

// A ball of 200 vertices above a leaflet of the small valve.
struct FacetedBall {
  ModelPtr model = make_model(small_valve());
  State state = initial_state(*model);
  Place at = place_above(*model, state.x, 40, 4e-3);

  FacetedBall() {
    Tool tool = convex_at(at.point, {polyhedral_ball(3e-3, 200)});
    tool.stiffness = 500;
    add_tool(*model, state, tool);
  }
};

}  // namespace

// With the least distance, which has kinks where facets lie parallel to triangles, neither tissue
// nor tool moved in 74 of these 200 steps, while the hand drew back by 2 mm.
TEST_CASE("a_tool_of_200_vertices_that_is_drawn_back_does_not_stick") {
  auto [model, state, at] = FacetedBall();
  steps_without_motion(*model, state, -2e-5 * at.normal, 500);
  CHECK(force_of(state, state.tools[0]).force.norm() > 1);
  CHECK(steps_without_motion(*model, state, 1e-5 * at.normal, 200) <= 5);
}

// With the least distance settles ended at kinks, up to 12 % off.
TEST_CASE("a_settle_under_a_tool_of_200_vertices_meets_the_balance_of_forces") {
  auto [model, state, at] = FacetedBall();
  for (int k = 0; k < 3; ++k) {
    steps_without_motion(*model, state, -2e-5 * at.normal, k == 0 ? 240 : 30);
    const Settled settled = settle(*model, state);
    CHECK(settled.stats.converged);
    const Vec3 hand = force_of(settled.state, settled.state.tools[0]).force;
    const Positions forces = evaluate_forces(*model, settled.state).total;
    Vec3 held = Vec3::Zero();
    for (uint32_t i = 0; i < forces.size(); ++i) {
      if (model->topology.fixed[i]) held += forces[i];
    }
    // the residual of 1e-5 N on each of 80 free nodes and points
    CHECK((held + hand).norm() <= 80e-5);
  }
}

TEST_CASE("a_convex_tool_is_refused_where_tissue_leaves_no_room") {
  const ModelPtr model = make_model(small_valve());
  State state = initial_state(*model);
  const Place at = place_above(*model, state.x, 40, 1e-3);
  CHECK_THROWS_WITH(add_tool(*model, state, convex_at(at.point, {ball_body(2e-3)})),
                    doctest::Contains("would lie in"));
  const Chord &chord = model->valve.chords[3];
  const Vec3 middle = 0.5 * (state.x[chord.a] + state.x[chord.b]);
  CHECK_THROWS_WITH(add_tool(*model, state, convex_at(middle, {ball_body(0.2e-3)})),
                    doctest::Contains("would lie in"));
  CHECK(state.tools.empty());
}
