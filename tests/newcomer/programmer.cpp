// A C++ programmer with mvs.hpp: exceptions, views, a plan for the operating room.
#include <mvs/mvs.hpp>

#include <algorithm>
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
  closed.save("closed.obj");
  sim.load_file("closed.obj");
  return sim.snapshot().hash() == closed.hash() ? 0 : 1;
} catch (const mvs::Error &error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
