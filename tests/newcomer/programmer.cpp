// A C++ programmer with mvs.hpp: exceptions, views, a plan for the operating room.
#include <mvs/mvs.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>

int main() try {
  mvs::Simulator sim;
  sim.generate();
  sim.set_load(MVS_SYSTOLE_PA);
  if (!sim.settle().converged) return 1;
  const mvs::Snapshot closed = sim.snapshot();
  double longest = 0;
  const auto stretch = closed.view<double>(MVS_ARRAY_TRIANGLE_STRETCH);
  for (size_t t = 0; t < stretch.rows(); ++t) longest = std::max(longest, stretch.row(t)[0]);
  std::printf("at rest: %d, longest stretch %.2f, %.1f mm2\n", closed.at_rest(), longest,
              closed.measure().regurgitant_orifice_area * 1e6);
  mvs_body_desc plate = {};
  plate.kind = MVS_BODY_KIND_BOX;
  plate.size[0] = plate.size[1] = 4e-3;
  plate.size[2] = 1e-3;
  mvs_tool_desc desc = {};
  desc.kind = MVS_TOOL_KIND_CONVEX;
  desc.bodies = &plate;
  desc.body_count = 1;
  desc.position[2] = 0.05;
  const mvs_id tool = sim.add_tool(desc);
  sim.move_tool_pose(tool, {0, 0, 0.049}, {1, 0, 0, 1});
  sim.step();
  if (std::abs(sim.tool(tool).orientation[3] - std::sqrt(0.5)) > 1e-15) return 1;
  closed.save("closed.obj");
  sim.load_file("closed.obj");
  return sim.snapshot().hash() == closed.hash() ? 0 : 1;
} catch (const mvs::Error &error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
