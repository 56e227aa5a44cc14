// Steps a closed valve with and without each optional call of an application.
#include "tests/bench/callers.h"

#include <functional>
#include <mvs/mvs.hpp>

#include "tests/bench/clock.h"

namespace bench {
namespace {

mvs::Simulator closed_valve(uint32_t vertices) {
  mvs::Simulator sim;
  mvs_parametric_desc desc = {};
  desc.shape = MVS_SHAPE_FOUNDING;
  desc.vertices = vertices;
  sim.generate(desc);
  sim.set_load(MVS_SYSTOLE_PA);
  sim.settle();
  return sim;
}

// The median of steps towards a lower pressure, each followed by the optional call.
double step_cost(mvs::Simulator sim, int steps,
                 const std::function<void(mvs::Simulator &)> &after) {
  sim.set_load(0.9 * MVS_SYSTOLE_PA);
  std::vector<double> cpu_s;
  for (int k = 0; k < steps; ++k) {
    const auto work = [&] {
      sim.step();
      if (after) after(sim);
    };
    cpu_s.push_back(timed(work).cpu);
  }
  return median(cpu_s);
}

mvs::Simulator with_levels(mvs::Simulator sim, int levels) {
  const auto chords = sim.snapshot().parts(MVS_PART_CHORD);
  for (int k = 0; k < levels; ++k) {
    mvs_op_chord_length op = {};
    op.chord = chords[static_cast<size_t>(k) % chords.size()].id;
    op.factor = k % 2 == 0 ? 0.9999 : 1 / 0.9999;
    sim.apply(op);
  }
  return sim;
}

}  // namespace

std::vector<Part> caller_parts(uint32_t vertices, int steps) {
  const auto valve = [=] { return closed_valve(vertices); };
  const double bare = step_cost(valve(), steps, {});
  const auto snap = [](mvs::Simulator &sim) { sim.snapshot(); };
  const auto measure = [](mvs::Simulator &sim) { sim.snapshot().measure(); };
  std::vector<Part> parts;
  parts.push_back({"snapshot each step", step_cost(valve(), steps, snap), bare});
  parts.push_back({"measures each step", step_cost(valve(), steps, measure), bare});
  parts.push_back({"100 levels of undo", step_cost(with_levels(valve(), 100), steps, {}), bare});
  const mvs::Snapshot closed = valve().snapshot();
  const double first = timed([&] { closed.measure(); }).cpu;
  parts.push_back({"measures, once more", first, timed([&] { closed.measure(); }).cpu});
  return parts;
}

}  // namespace bench
