// A simulator with a parametric valve, as the scenes of the golden digests drive it.
#pragma once

#include <mvs/mvs.h>

#include <cstring>
#include <string>

#include "tests/golden/scenes.h"

namespace golden {

template <typename Struct>
Struct sized() {
  Struct made;
  std::memset(&made, 0, sizeof made);
  made.struct_size = sizeof made;
  return made;
}

inline uint32_t worker_threads = 0;

// A simulator with a parametric valve.
class Sim {
 public:
  explicit Sim(uint32_t vertices, uint32_t law = MVS_LEAFLET_LAW_SPRING, uint32_t branching = 0) {
    auto how = sized<mvs_sim_desc>();
    how.workers = worker_threads;
    check(mvs_create(&how, &sim_));
    auto desc = sized<mvs_parametric_desc>();
    desc.shape = MVS_SHAPE_FOUNDING;
    desc.vertices = vertices;
    desc.branching = branching;
    check(mvs_generate_valve(sim_, &desc));
    mvs_leaflet_desc tissue = {};
    tissue.law = law;
    if (law != MVS_LEAFLET_LAW_SPRING) check(mvs_set_leaflet(sim_, 0, &tissue));
  }
  Sim(const Sim &) = delete;
  Sim &operator=(const Sim &) = delete;
  ~Sim() { mvs_destroy(sim_); }

  operator mvs_sim *() const { return sim_; }

  void load(double pressure = MVS_SYSTOLE_PA) {
    const mvs_load_case load = {sizeof load, 0, pressure, 1};
    check(mvs_set_load(sim_, &load));
  }
  void settle(uint32_t solver = MVS_SOLVER_NEWTON, uint32_t iterations = 0) {
    auto options = sized<mvs_settle_options>();
    options.solver = solver;
    options.max_iterations = iterations;
    check(mvs_settle(sim_, &options, nullptr));
  }
  void step(int count, uint32_t solver = MVS_SOLVER_IMPLICIT) {
    auto options = sized<mvs_step_options>();
    options.solver = solver;
    for (int k = 0; k < count; ++k) check(mvs_step(sim_, &options));
  }
  void record(const Record &record, const std::string &scene) const {
    const mvs_snapshot *snapshot = nullptr;
    check(mvs_get_snapshot(sim_, &snapshot));
    record(scene, snapshot);
    mvs_snapshot_release(snapshot);
  }
  mvs_part part(uint32_t kind, const char *name) const {
    const mvs_snapshot *snapshot = nullptr;
    mvs_part part;
    check(mvs_get_snapshot(sim_, &snapshot));
    check(mvs_snapshot_find_part(snapshot, kind, name, &part));
    mvs_snapshot_release(snapshot);
    return part;
  }
  mvs_id id(uint32_t kind, const char *name) const { return part(kind, name).id; }
  void node_position(uint32_t node, double *p) const {
    const mvs_snapshot *snapshot = nullptr;
    mvs_view view;
    check(mvs_get_snapshot(sim_, &snapshot));
    check(mvs_snapshot_get_array(snapshot, MVS_ARRAY_NODE_POSITION, &view));
    std::memcpy(p, static_cast<const double *>(view.data) + 3 * size_t{node}, 3 * sizeof *p);
    mvs_snapshot_release(snapshot);
  }

 private:
  mvs_sim *sim_ = nullptr;
};

}  // namespace golden
