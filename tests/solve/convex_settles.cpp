// Settles under convex tools that are pressed deep into tissue.
#include <doctest/doctest.h>

#include <cstdint>

#include "tests/model/small_valve.h"
#include "tests/solve/bench.h"
#include "tests/solve/convex_tools.h"

using namespace mvs::core;
using namespace mvs::core::test;

namespace {

// A ball of 200 vertices, a rounded box, a capsule; facets and edges begin parallel to tissue in
// the last two.
Tool blunt_tool(int kind, const Place &at, const Vec3 &turn) {
  Tool tool = convex_at(at.point, {polyhedral_ball(3e-3, 200)});
  if (kind == 1) tool = convex_at(at.point, {box_body(Vec3(2e-3, 1.5e-3, 1e-3), 0.2e-3)});
  if (kind == 3) tool = convex_at(at.point, {capsule_body(at.along, 5e-3, 1e-3)});
  if (kind % 2 == 0) tool.axis = turn;
  tool.stiffness = 500;
  tool.max_force = 5;
  return tool;
}

}  // namespace

// Pressed to 2, 4 and 6 mm at 20 places, a third of them on a valve under pressure. With the least
// distance 25 of the 60 settles converged, after 240 iterations on average.
TEST_CASE("settles_with_convex_tools_pressed_deep_converge") {
  const ModelPtr model = make_model(small_valve());
  const State open = initial_state(*model);
  State loaded = open;
  loaded.load = {2000, 0};
  loaded = settle(*model, loaded).state;
  uint32_t iterations = 0;
  for (int k = 0; k < 20; ++k) {
    CAPTURE(k);
    State state = k % 3 == 0 ? loaded : open;
    Random random(k + 1);
    const Place at = place_above(*model, state.x, 32 + (k * 7) % 60, 4e-3);
    Tool tool = blunt_tool(k % 4, at, random.vector(0.5));
    const auto room = [&] {
      Tool placed = tool;
      for (uint32_t p = 0; p < frame_points; ++p) placed.proxy[p] = tool.target(p);
      return clearance(*model, state.x, placed);
    };
    while (room() < 0.5e-3) tool.position += 1e-3 * at.normal;
    const double off = (tool.position - at.point).norm();
    add_tool(*model, state, tool);
    Solver solver(Backend::fastest);
    for (int depth = 1; depth <= 3; ++depth) {
      const int steps = static_cast<int>((depth == 1 ? 3e-3 + off : 2e-3) / 2e-5);
      for (int s = 0; s < steps; ++s) {
        state.tools[0].position -= 2e-5 * at.normal;
        solver.step(*model, state, {});
      }
      const Settled settled = settle(*model, state);
      CAPTURE(depth);
      CHECK(settled.stats.converged);
      iterations += settled.stats.iterations;
    }
  }
  MESSAGE(iterations << " iterations in 60 settles");
  CHECK(iterations <= 60 * 30);
}
