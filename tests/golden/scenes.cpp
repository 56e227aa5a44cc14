// The pinned scenes. Every scene starts from the parametric valve, so that the generator is pinned
// as well.
#include "tests/golden/scenes.h"

#include <mvs/experimental.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace golden {
namespace {

template <typename Struct>
Struct sized() {
  Struct made;
  std::memset(&made, 0, sizeof made);
  made.struct_size = sizeof made;
  return made;
}

uint32_t worker_threads = 0;

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

mvs_site site_in(const Sim &sim, const char *scallop, double along, double down) {
  mvs_site site = {};
  site.how = MVS_SITE_ANATOMICAL;
  site.scallop = sim.id(MVS_PART_SCALLOP, scallop);
  site.u[0] = along;
  site.u[1] = down;
  return site;
}

template <typename Op>
Op op_of(uint32_t kind) {
  Op op;
  std::memset(&op, 0, sizeof op);
  op.op = {sizeof op, kind};
  return op;
}

// One operation on the closed valve: the bits before and after settling.
struct OpCase {
  const char *name;
  std::function<void(const Sim &)> apply;
};

template <typename Op, typename Fill>
OpCase op_case(const char *name, uint32_t kind, Fill fill) {
  return {name, [=](const Sim &sim) {
            auto op = op_of<Op>(kind);
            fill(sim, op);
            check(mvs_apply_op(sim, &op.op, nullptr));
          }};
}

std::vector<OpCase> op_cases() {
  const auto chord = [](const Sim &sim, const char *name) { return sim.id(MVS_PART_CHORD, name); };
  const auto head = [](const Sim &sim, const char *name) { return sim.id(MVS_PART_HEAD, name); };
  return {
      op_case<mvs_op_chord_length>("chord_length", MVS_OP_CHORD_LENGTH,
                                   [=](const Sim &sim, auto &op) {
                                     op.chord = chord(sim, "A2/7");
                                     op.factor = 0.75;
                                   }),
      op_case<mvs_op_chord_remove>(
          "chord_remove", MVS_OP_CHORD_REMOVE,
          [=](const Sim &sim, auto &op) { op.chord = chord(sim, "P2/2"); }),
      op_case<mvs_op_chord_add>("chord_add", MVS_OP_CHORD_ADD,
                                [=](const Sim &sim, auto &op) {
                                  op.head = head(sim, "AL1");
                                  op.site = site_in(sim, "A2", 0.62, 0.85);
                                }),
      op_case<mvs_op_chord_transfer>("chord_transfer leaflet", MVS_OP_CHORD_TRANSFER,
                                     [=](const Sim &sim, auto &op) {
                                       op.chord = chord(sim, "P2/6");
                                       op.site = site_in(sim, "A2", 0.4, 0.8);
                                     }),
      op_case<mvs_op_chord_transfer>("chord_transfer head", MVS_OP_CHORD_TRANSFER,
                                     [=](const Sim &sim, auto &op) {
                                       op.chord = chord(sim, "A2/2");
                                       op.end = MVS_CHORD_END_HEAD;
                                       op.head = head(sim, "PM2");
                                     }),
      op_case<mvs_op_annulus_scale>("annulus_scale", MVS_OP_ANNULUS_SCALE,
                                    [](const Sim &, auto &op) {
                                      op.factor = 1.1;
                                      op.ap = 1.05;
                                    }),
      op_case<mvs_op_ring>("ring", MVS_OP_RING, [](const Sim &, auto &op) { op.size = 0.032; }),
      op_case<mvs_op_band>("band", MVS_OP_BAND, [](const Sim &, auto &op) { op.factor = 0.9; }),
      op_case<mvs_op_neochord>("neochord", MVS_OP_NEOCHORD,
                               [=](const Sim &sim, auto &op) {
                                 op.head = head(sim, "PM1");
                                 op.site = site_in(sim, "P2", 0.5, 1);
                                 op.length = 14e-3;
                               }),
      op_case<mvs_op_head_move>("head_move", MVS_OP_HEAD_MOVE,
                                [=](const Sim &sim, auto &op) {
                                  op.head = head(sim, "PM1");
                                  op.by[2] = -3e-3;
                                  op.frame = 1;
                                }),
      op_case<mvs_op_clip>("clip", MVS_OP_CLIP, [](const Sim &, auto &) {}),
      op_case<mvs_op_resect>("resect triangle", MVS_OP_RESECT, [](const Sim &, auto &) {}),
      op_case<mvs_op_resect>("resect quadrangle", MVS_OP_RESECT,
                             [](const Sim &, auto &op) {
                               op.width = 8e-3;
                               op.base_width = 5e-3;
                             }),
      op_case<mvs_op_patch>(
          "patch", MVS_OP_PATCH,
          [](const Sim &sim, auto &op) { op.site = site_in(sim, "A2", 0.5, 0.5); }),
  };
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
