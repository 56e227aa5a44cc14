// Failure injection: for each call the n-th allocation fails, for one n after the other. The call
// then returns MVS_E_MEMORY, the simulator and its snapshots are unchanged to the bit, and no
// memory leaks.
#include <mvs/experimental.h>
#include <mvs/mvs.h>

#include <chrono>
#include <cstdio>
#include <cstring>
#include <functional>
#include <string>
#include <vector>

#include "check.h"
#include "funnel.h"
#include "tests/fault/allocator.h"
#include "tests/short_run.h"

namespace {

// The objects that a call works on: made anew for each attempt, so that nothing is cached.
struct Scene {
  mvs_sim *sim = nullptr;
  const mvs_snapshot *snapshot = nullptr;
};

funnel valve;
std::string saved, saved_session;  // the valve as a file
std::string plan;

mvs_load_case light_load() {
  mvs_load_case load = funnel_load();
  load.pressure /= 10;
  return load;
}

Scene make_scene() {
  Scene scene;
  const mvs_load_case load = light_load();
  MUST(mvs_create(nullptr, &scene.sim));
  // another annulus each time: the process keeps what depends on the last few (annulus_map.h,
  // sheet_topology.h)
  valve.nodes[valve.annulus[0]][2] += 1e-12;
  MUST(mvs_set_valve(scene.sim, &valve.desc));
  MUST(mvs_set_load(scene.sim, &load));
  MUST(mvs_get_snapshot(scene.sim, &scene.snapshot));
  return scene;
}

void free_scene(const Scene &scene) {
  mvs_snapshot_release(scene.snapshot);
  mvs_destroy(scene.sim);
}

struct Call {
  const char *name;
  std::function<mvs_result(Scene &)> make;
};

// The number of allocations of a call when none fails.
long count_allocations(const Call &call) {
  Scene scene = make_scene();
  fault::fail_from(0);
  MUST(call.make(scene));
  const long count = fault::allocations();
  free_scene(scene);
  return count;
}

// Fails allocation n of one call in a new scene.
void fail_allocation(const Call &call, long n) {
  const long before = fault::alive();
  Scene scene = make_scene();
  const hash128 start = sim_hash(scene.sim);
  fault::fail_from(n);
  const mvs_result result = call.make(scene);
  const bool failed = fault::has_failed();
  fault::fail_from(0);
  const bool same =
      same_hash(start, sim_hash(scene.sim)) && same_hash(start, snapshot_hash(scene.snapshot));
  free_scene(scene);
  const bool leaked = fault::alive() != before;
  if (failed && result == MVS_E_MEMORY && same && !leaked) return;
  ++failures;
  std::printf("%s, allocation %ld: %s%s%s%s\n", call.name, n, mvs_result_name(result),
              failed ? "" : ", not reached", same ? "" : ", changed", leaked ? ", leaked" : "");
}

// Every one of the first allocations, which cover most kinds; of thousands in a loop some hundred,
// spread evenly, since each attempt costs a whole call.
void fail_each_allocation(const Call &call) {
  const long all_of_first = short_run() ? 80 : 800, spread = short_run() ? 40 : 150;
  using Clock = std::chrono::steady_clock;
  const Clock::time_point begin = Clock::now();
  const long count = count_allocations(call);
  long attempts = 0;
  for (long n = 1; n <= count && failures < 10; ++attempts) {
    fail_allocation(call, n);
    n += n < all_of_first ? 1 : 1 + (count - all_of_first) / spread;
  }
  const double seconds = std::chrono::duration<double>(Clock::now() - begin).count();
  std::printf("%-14s %6ld of %6ld allocations failed, %.2f s\n", call.name, attempts, count,
              seconds);
  std::fflush(stdout);
}

mvs_result view(const Scene &scene, uint32_t which) {
  mvs_view found;
  return mvs_snapshot_get_array(scene.snapshot, which, &found);
}

mvs_result save(const Scene &scene, uint32_t format) {
  uint64_t size = 0;
  return mvs_save_memory(scene.snapshot, format, nullptr, 0, &size);
}

std::vector<Call> calls() {
  return {
      {"create",
       [](Scene &) {
         mvs_sim *sim = nullptr;
         const mvs_result result = mvs_create(nullptr, &sim);
         mvs_destroy(sim);
         return result;
       }},
      {"set_valve", [](Scene &s) { return mvs_set_valve(s.sim, &valve.desc); }},
      {"check_valve", [](Scene &) { return mvs_check_valve(&valve.desc, nullptr, nullptr); }},
      {"generate",
       [](Scene &s) {
         mvs_parametric_desc desc = {};
         desc.shape = MVS_SHAPE_FOUNDING;
         desc.struct_size = sizeof desc;
         desc.vertices = 200;
         return mvs_generate_valve(s.sim, &desc);
       }},
      {"set_load",
       [](Scene &s) {
         const mvs_load_case load = funnel_load();
         return mvs_set_load(s.sim, &load);
       }},
      {"settle",
       [](Scene &s) {
         mvs_settle_options options = {};
         options.struct_size = sizeof options;
         options.max_iterations = 2;
         return mvs_settle(s.sim, &options, nullptr);
       }},
      {"step implicit", [](Scene &s) { return mvs_step(s.sim, nullptr); }},
      {"step explicit",
       [](Scene &s) {
         const mvs_step_options options = {sizeof options, MVS_SOLVER_EXPLICIT, 0, 0, 0, 0};
         return mvs_step(s.sim, &options);
       }},
      {"restore", [](Scene &s) { return mvs_restore(s.sim, s.snapshot); }},
      {"load_memory",
       [](Scene &s) { return mvs_load_memory(s.sim, saved.data(), saved.size(), 0); }},
  };
}

std::vector<Call> calls_of_snapshots() {
  return {
      {"forces", [](Scene &s) { return view(s, MVS_ARRAY_NODE_FORCE); }},
      {"tables", [](Scene &s) { return view(s, MVS_ARRAY_CHORD_NODES); }},
      {"coaptation", [](Scene &s) { return view(s, MVS_ARRAY_NODE_COAPTATION); }},
      {"strain", [](Scene &s) { return view(s, MVS_ARRAY_TRIANGLE_STRESS); }},
      {"chords", [](Scene &s) { return view(s, MVS_ARRAY_CHORD_TENSION); }},
      {"measure",
       [](Scene &s) {
         mvs_measures measures = {};
         measures.struct_size = sizeof measures;
         return mvs_snapshot_measure(s.snapshot, &measures);
       }},
      {"compare",
       [](Scene &s) {
         mvs_comparison comparison = {};
         comparison.struct_size = sizeof comparison;
         return mvs_snapshot_compare(s.snapshot, s.snapshot, &comparison);
       }},
      {"ensemble",
       [](Scene &s) {
         mvs_ensemble *ensemble = nullptr;
         const mvs_load_case load = light_load();
         mvs_settle_options settle = {};
         settle.struct_size = sizeof settle;
         settle.max_iterations = 1;
         mvs_ensemble_options options = {};
         options.struct_size = sizeof options;
         options.members = 2;
         mvs_measures mean = {};
         mean.struct_size = sizeof mean;
         mvs_result result = mvs_ensemble_run(s.snapshot, &load, &settle, &options, &ensemble);
         if (result == MVS_OK)
           result = mvs_ensemble_measure(ensemble, MVS_ENSEMBLE_STATISTIC_MEAN, &mean);
         mvs_ensemble_release(ensemble);
         return result;
       }},
      {"section",
       [](Scene &s) {
         const double at[3] = {0, 0, -1e-3}, up[3] = {0, 0, 1};
         uint64_t count = 0;
         return mvs_snapshot_section(s.snapshot, at, up, nullptr, 0, &count);
       }},
      {"frame",
       [](Scene &s) {
         double frame[12];
         return mvs_snapshot_get_frame(s.snapshot, frame);
       }},
      {"save obj", [](Scene &s) { return save(s, MVS_FORMAT_OBJ); }},
      {"save vtp", [](Scene &s) { return save(s, MVS_FORMAT_VTP); }},
  };
}

mvs_id first_part(const Scene &s, uint32_t kind) {
  mvs_part part = {};
  MUST(mvs_snapshot_get_part(s.snapshot, kind, 0, &part));
  return part.id;
}

mvs_result scale_annulus(const Scene &s) {
  const mvs_op_annulus_scale op = {{sizeof op, MVS_OP_ANNULUS_SCALE}, 0.9, 0, 0};
  return mvs_apply_op(s.sim, &op.op, nullptr);
}

std::vector<Call> calls_of_operations() {
  return {
      {"scale annulus", [](Scene &s) { return scale_annulus(s); }},
      {"remove chord",
       [](Scene &s) {
         const mvs_op_chord_remove op = {{sizeof op, MVS_OP_CHORD_REMOVE},
                                         first_part(s, MVS_PART_CHORD)};
         return mvs_apply_op(s.sim, &op.op, nullptr);
       }},
      {"add chord",
       [](Scene &s) {
         mvs_op_chord_add op = {};
         op.op = {sizeof op, MVS_OP_CHORD_ADD};
         op.head = first_part(s, MVS_PART_HEAD);
         op.site.how = MVS_SITE_ANATOMICAL;
         op.site.scallop = first_part(s, MVS_PART_SCALLOP);
         op.site.u[0] = op.site.u[1] = 0.45;
         return mvs_apply_op(s.sim, &op.op, nullptr);
       }},
      {"group", [](Scene &s) { return mvs_begin_group(s.sim, "a group"); }},
      {"checkpoint", [](Scene &s) { return mvs_set_checkpoint(s.sim, "a place"); }},
      {"replay plan",
       [](Scene &s) { return mvs_replay_plan(s.sim, plan.data(), plan.size(), nullptr); }},
      {"write plan",
       [](Scene &s) {
         uint64_t size = 0;
         return mvs_write_plan(s.snapshot, nullptr, nullptr, 0, &size);
       }},
  };
}

std::vector<Call> calls_with_hdf5() {
  return {{"load h5",
           [](Scene &s) {
             return mvs_load_memory(s.sim, saved_session.data(), saved_session.size(),
                                    MVS_FORMAT_H5);
           }},
          {"save h5", [](Scene &s) { return save(s, MVS_FORMAT_H5); }}};
}

std::string save_scene(uint32_t format) {
  const Scene scene = make_scene();
  uint64_t size = 0;
  MUST(mvs_save_memory(scene.snapshot, format, nullptr, 0, &size));
  std::string bytes(size, ' ');
  MUST(mvs_save_memory(scene.snapshot, format, bytes.data(), size, &size));
  free_scene(scene);
  return bytes;
}

}  // namespace

int main() {
  make_funnel(&valve);
  // fills what the process keeps (annulus_map.h, sheet_topology.h): it would count as leaked
  for (int k = 0; k < 4; ++k) {
    const Scene scene = make_scene();
    mvs_measures measures = {};
    measures.struct_size = sizeof measures;
    MUST(mvs_snapshot_measure(scene.snapshot, &measures));
    free_scene(scene);
  }
  saved = save_scene(MVS_FORMAT_OBJ);
  for (const Call &call : calls()) fail_each_allocation(call);
  for (const Call &call : calls_of_snapshots()) fail_each_allocation(call);
  plan = R"({"format": "mvs-plan", "version": 1, "steps": [{"do": "annulus_scale", "factor": 0.9},
    {"do": "chord_length", "chord": "A/1", "factor": 0.9}]})";
  for (const Call &call : calls_of_operations()) fail_each_allocation(call);
  if (std::strstr(mvs_features(), "hdf5")) {
    saved_session = save_scene(MVS_FORMAT_H5);
    for (const Call &call : calls_with_hdf5()) fail_each_allocation(call);
  }
  return finish("fault");
}
