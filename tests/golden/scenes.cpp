// The pinned scenes. Every scene starts from the parametric valve, so that the generator is pinned
// as well.
#include "tests/golden/scenes.h"

#include <mvs/experimental.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include "tests/golden/operations.h"
#include "tests/golden/sim.h"

namespace golden {
namespace {

constexpr uint32_t small = 425, medium = 1700;

void close_valves(const Record &record) {
  const struct {
    const char *name;
    uint32_t vertices, law, branching;
  } cases[] = {{"close S spring", small, MVS_LEAFLET_LAW_SPRING, 0},
               {"close S bilinear", small, MVS_LEAFLET_LAW_BILINEAR, 0},
               {"close S may_newman_yin", small, MVS_LEAFLET_LAW_MAY_NEWMAN_YIN, 0},
               {"close S fung branching", small, MVS_LEAFLET_LAW_FUNG, 1},
               {"close M spring", medium, MVS_LEAFLET_LAW_SPRING, 0},
               {"close M bilinear", medium, MVS_LEAFLET_LAW_BILINEAR, 0},
               {"close M prot", medium, MVS_LEAFLET_LAW_PROT, 0}};
  for (const auto &c : cases) {
    Sim sim(c.vertices, c.law, c.branching);
    sim.load();
    sim.settle();
    sim.record(record, c.name);
  }
}

// The other solvers, stopped early: their bits matter, not their convergence.
void close_in_time(const Record &record) {
  Sim sim(small);
  sim.load();
  sim.settle(MVS_SOLVER_IMPLICIT, 300);
  sim.record(record, "settle by implicit steps");
  Sim other(small);
  other.load();
  other.settle(MVS_SOLVER_EXPLICIT, 400);
  other.record(record, "settle by explicit steps");
  other.step(20, MVS_SOLVER_EXPLICIT);
  other.record(record, "explicit steps");
}

mvs_id add_tool(const Sim &sim, uint32_t kind, uint32_t node, const double *at) {
  auto desc = sized<mvs_tool_desc>();
  desc.kind = kind;
  std::memcpy(desc.position, at, sizeof desc.position);
  desc.by_node = kind == MVS_TOOL_KIND_GRASP;
  desc.node = node;
  mvs_id id = 0;
  check(mvs_add_tool(sim, &desc, &id));
  return id;
}

// 200 steps of a hand that drags a node, a ball or a rod by 20 um a step.
void move_tool(Sim &sim, mvs_id tool, const double *from, const double *towards) {
  double at[3];
  std::memcpy(at, from, sizeof at);
  for (int k = 0; k < 200; ++k) {
    for (int c = 0; c < 3; ++c) at[c] += 20e-6 * towards[c];
    check(mvs_move_tool(sim, tool, at, nullptr));
    sim.step(1);
  }
}

void tool_trajectories(const Record &record) {
  const struct {
    const char *name;
    uint32_t law, kind;
    double towards[3];
  } cases[] = {
      {"200 steps grasp spring", MVS_LEAFLET_LAW_SPRING, MVS_TOOL_KIND_GRASP, {0.3, 0.2, 0.9}},
      {"200 steps grasp bilinear", MVS_LEAFLET_LAW_BILINEAR, MVS_TOOL_KIND_GRASP, {0.1, -0.6, 0.7}},
      {"200 steps ball spring", MVS_LEAFLET_LAW_SPRING, MVS_TOOL_KIND_BALL, {0.1, 0.1, -1}},
      {"200 steps rod prot", MVS_LEAFLET_LAW_PROT, MVS_TOOL_KIND_ROD, {0.1, 0, -1}}};
  for (const auto &c : cases) {
    Sim sim(small, c.law);
    sim.load();
    sim.settle();
    double at[3];
    const uint32_t node = 200;
    sim.node_position(node, at);
    if (c.kind != MVS_TOOL_KIND_GRASP) at[2] += 6e-3;
    move_tool(sim, add_tool(sim, c.kind, node, at), at, c.towards);
    sim.record(record, c.name);
  }
  Sim sim(small);
  sim.load();
  sim.step(200);  // a sudden load, no hand
  sim.record(record, "200 steps load at once");
}

void operate(const Record &record) {
  Sim sim(small);
  sim.load();
  sim.settle();
  for (const OpCase &c : op_cases()) {
    c.apply(sim);
    sim.record(record, std::string("op ") + c.name);
    sim.settle();
    sim.record(record, std::string("op ") + c.name + " settled");
    check(mvs_undo(sim));
  }
  sim.record(record, "op all undone");
  Sim membrane(small, MVS_LEAFLET_LAW_BILINEAR);
  membrane.load();
  membrane.settle();
  for (const OpCase &c : op_cases()) {
    // a quadrangle gathers the annulus, which a ring or band then holds
    if (std::strcmp(c.name, "resect quadrangle") != 0) c.apply(membrane);
  }
  membrane.settle(MVS_SOLVER_NEWTON, 60);
  membrane.record(record, "op all in a row membrane");
}

// A plan that loads, settles, steps, moves a tool and operates.
void replay(const Record &record) {
  Sim sim(small);
  sim.load();
  sim.settle();
  op_cases()[0].apply(sim);
  sim.settle();
  double at[3];
  sim.node_position(150, at);
  const double up[3] = {0, 0, 1};
  const mvs_id tool = add_tool(sim, MVS_TOOL_KIND_GRASP, 150, at);
  move_tool(sim, tool, at, up);
  check(mvs_remove_tool(sim, tool));
  op_cases()[6].apply(sim);
  sim.settle();
  sim.record(record, "plan recorded");
  const mvs_snapshot *snapshot = nullptr;
  check(mvs_get_snapshot(sim, &snapshot));
  uint64_t size = 0;
  check(mvs_write_plan(snapshot, nullptr, nullptr, 0, &size));
  std::string text(size, '\0');
  check(mvs_write_plan(snapshot, nullptr, text.data(), size, &size));
  mvs_snapshot_release(snapshot);
  Sim again(small);
  check(mvs_replay_plan(again, text.data(), text.size(), nullptr));
  again.record(record, "plan replayed");
}

// Mesh levels, and the paths of an ensemble.
void levels(const Record &record) {
  Sim sim(medium);
  auto options = sized<mvs_coarsen_options>();
  options.vertices = 600;
  check(mvs_coarsen_valve(sim, &options, nullptr));
  sim.record(record, "coarsened");
  sim.load();
  sim.settle();
  sim.record(record, "coarsened and closed");
  check(mvs_refine_valve(sim));
  sim.record(record, "refined");
}

void paths(const Record &record) {
  Sim sim(small);
  const mvs_load_case systole = {sizeof systole, 0, MVS_SYSTOLE_PA, 1};
  auto options = sized<mvs_ensemble_options>();
  options.members = 4;
  const mvs_snapshot *start = nullptr;
  check(mvs_get_snapshot(sim, &start));
  mvs_ensemble *ensemble = nullptr;
  check(mvs_ensemble_run(start, &systole, nullptr, &options, &ensemble));
  mvs_snapshot_release(start);
  for (uint32_t k = 0; k < options.members; ++k) {
    const mvs_snapshot *snapshot = nullptr;
    check(mvs_ensemble_get_member_snapshot(ensemble, k, &snapshot));
    record("path " + std::to_string(k), snapshot);
    mvs_snapshot_release(snapshot);
  }
  mvs_ensemble_release(ensemble);
}

}  // namespace

void use_workers(uint32_t workers) {
  worker_threads = workers;
}

void check(mvs_result result) {
  if (result == MVS_OK) return;
  std::fprintf(stderr, "golden: %s\n", mvs_last_error()->message);
  std::exit(1);
}

std::vector<Group> groups() {
  return {{"close", close_valves}, {"time", close_in_time}, {"hand", tool_trajectories},
          {"op", operate},         {"plan", replay},        {"levels", levels},
          {"paths", paths}};
}

}  // namespace golden
