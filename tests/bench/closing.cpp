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
  mvs_sim_desc how = {};
  how.workers = of.workers;
  mvs::Simulator sim(how);
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

// A pool that runs its tasks one after the other, and the CPU time of its loops.
struct CountingPool {
  uint32_t width;
  double seconds = 0;

  static uint32_t width_of(void *user) { return static_cast<CountingPool *>(user)->width; }
  static void run(void *user, uint32_t count, mvs_task_fn task, void *context) {
    const Seconds took = timed([&] {
      for (uint32_t k = 0; k < count; ++k) task(context, k);
    });
    static_cast<CountingPool *>(user)->seconds += took.cpu;
  }
};

}  // namespace

double shared_part(const Case &of) {
  CountingPool pool{of.workers};
  mvs_sim_desc how = {};
  how.user = &pool;
  how.pool_width = &CountingPool::width_of;
  how.run_tasks = &CountingPool::run;
  mvs::Simulator sim(how);
  make(sim, of);
  const Seconds took = timed([&] { sim.settle(options_of(of)); });
  return pool.seconds / took.cpu;
}

double Closing::other() const {
  double rest = cpu();
  for (size_t k = 0; k < phase_names.size(); ++k) rest -= phase(k);
  return rest;
}

Closing close(const Case &of, int repeat) {
  return close_in_turn({of}, repeat).front();
}

std::vector<Closing> close_in_turn(const std::vector<Case> &cases, int repeat) {
  std::vector<Closing> closings(cases.size());
  for (int k = 0; k < repeat; ++k) {
    for (size_t c = 0; c < cases.size(); ++c) close_once(cases[c], closings[c]);
  }
  for (Closing &closing : closings) measure(closing);
  return closings;
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
