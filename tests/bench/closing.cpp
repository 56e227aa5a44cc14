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
  if (!of.file.empty()) {
    sim.load_file(of.file);
    return;
  }
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
  closing.closed = sim.snapshot().save_memory(MVS_FORMAT_OBJ);
}

}  // namespace

double Closing::other() const {
  double rest = cpu();
  for (size_t k = 0; k < phase_names.size(); ++k) rest -= phase(k);
  return rest;
}

Closing close(const Case &of, int repeat) {
  Closing closing;
  for (int k = 0; k < repeat; ++k) close_once(of, closing);
  measure(closing);
  return closing;
}

std::string open_valve(const Case &of) {
  mvs::Simulator sim;
  make(sim, of);
  return sim.snapshot().save_memory(MVS_FORMAT_OBJ);
}

void measure(Closing &closing) {
  if (closing.closed.empty()) return;
  mvs::Simulator sim;
  sim.load_memory(closing.closed, MVS_FORMAT_OBJ);
  const mvs::Snapshot closed = sim.snapshot();
  closing.vertices = leaflet_vertices(closed);
  closing.measures = closed.measure();
}

mvs_comparison distance(const std::string &a, const std::string &b) {
  mvs::Simulator first, second;
  first.load_memory(a, MVS_FORMAT_OBJ);
  second.load_memory(b, MVS_FORMAT_OBJ);
  return first.snapshot().compare(second.snapshot());
}

}  // namespace bench
