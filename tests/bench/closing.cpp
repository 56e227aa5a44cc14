// Closes generated valves, for every bench that needs one closed.
#include "tests/bench/closing.h"

#include <mvs/experimental.hpp>

namespace bench {
namespace {

size_t leaflet_vertices(const mvs::Snapshot &valve) {
  const auto kinds = valve.view<uint8_t>(MVS_ARRAY_NODE_KIND);
  return static_cast<size_t>(std::count_if(kinds.begin(), kinds.end(), [](uint8_t kind) {
    return kind == MVS_NODE_KIND_LEAFLET || kind == MVS_NODE_KIND_ANNULUS;
  }));
}

void make(mvs::Simulator &sim, const Case &of) {
  mvs_parametric_desc valve = {};
  valve.shape = MVS_SHAPE_FOUNDING;
  valve.vertices = scene_vertices.at(of.scene);
  sim.generate(valve);
  if (of.leaflet == "membrane") {
    mvs_leaflet_desc tissue = {};
    tissue.law = MVS_LEAFLET_LAW_BILINEAR;
    sim.set_leaflet(tissue);
  }
  sim.set_load(MVS_SYSTOLE_PA);
}

mvs_settle_options options_of(const Case &of) {
  mvs_settle_options options = {};
  options.solver = solver_names.at(of.solver);
  options.residual = of.residual;
  options.dt = of.dt;
  options.damping = of.damping;
  options.max_iterations = of.most;
  return options;
}

void close_once(const Case &of, Closing &closing) {
  mvs::Simulator sim;
  make(sim, of);
  const Seconds took = timed([&] {
    try {
      closing.stats = sim.settle(options_of(of));
      closing.profile = mvs::profile_of(sim);
    } catch (const mvs::Error &error) {
      if (error.code() != MVS_E_DIVERGED) throw;
      closing.diverged = true;
    }
  });
  closing.cpu_s.push_back(took.cpu);
  closing.wall_s.push_back(took.wall);
  const mvs::Snapshot closed = sim.snapshot();
  closing.vertices = leaflet_vertices(closed);
  closing.measures = closed.measure();
}

}  // namespace

Closing close(const Case &of, int repeat) {
  Closing closing;
  for (int k = 0; k < repeat; ++k) close_once(of, closing);
  return closing;
}

}  // namespace bench
