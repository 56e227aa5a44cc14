// What closing again costs after one surgical operation, beside closing the same valve from open.
//
//   bench_reclose                    scenes S, M and two sick valves; every operation on each
//   bench_reclose --scenes S --repeat 1
//
// A valve is closed, then operated on. The changed valve is closed twice: from open, and from where
// the operation left it. Columns: iterations and wall time (the median of the runs) of both, their
// ratio, and how far apart the two closed shapes are. The last line is the median over all
// operations.
//
// Exit code 1: a valve did not come to rest, or meets itself.
#include <mvs/op.h>
#include <mvs/sim.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "anatomy/parametric.h"
#include "base/error.h"
#include "base/intersect.h"
#include "physics/solver.h"
#include "surgery/history.h"

using namespace mvs;

namespace {

struct Scene {
  uint32_t vertices;
  double annulus_scale;
  bool long_strut;
};
const std::map<std::string, Scene> scenes = {{"S", {425, 1, false}},
                                             {"M", {1700, 1, false}},
                                             {"L", {6800, 1, false}},
                                             {"sickS", {425, 1.15, true}},
                                             {"sickM", {1700, 1.15, true}}};

struct Operation {
  std::string kind, name;
  std::function<Operated(const Picture &closed)> apply;
};

struct Options {
  std::vector<std::string> scenes = {"S", "sickS", "M", "sickM"};
  int repeat = 3;
};

struct Run {
  SolveStats stats;
  State state;
  std::vector<double> wall_s;
  double median_s() const { return wall_s[wall_s.size() / 2]; }
};

Valve make_scene(const Scene &scene) {
  mvs_parametric_desc desc = {};
  desc.struct_size = sizeof desc;
  desc.vertices = scene.vertices;
  desc.annulus_scale = scene.annulus_scale;
  Valve valve = make_parametric_valve(desc);
  for (Chord &c : valve.chords) {
    if (scene.long_strut && c.name == "A2/7") c.rest_length *= 1.25;
  }
  return valve;
}

template <typename Op>
Op op_of(uint32_t kind) {
  Op op = {};
  op.op = {sizeof op, kind};
  return op;
}

template <typename Part>
Id id_of(const std::vector<Part> &parts, const std::string &name) {
  for (const Part &part : parts) {
    if (part.name == name) return part.id;
  }
  fail(MVS_E_ARGUMENT, "bench", "the valve has no %s", name.c_str());
}

mvs_site site_in(const Valve &v, const std::string &scallop, double along, double down) {
  mvs_site site = {};
  site.how = MVS_SITE_ANATOMICAL;
  site.scallop = id_of(v.scallops.get(), scallop);
  site.u[0] = along;
  site.u[1] = down;
  return site;
}

Operation chord_length(const std::string &name, double factor) {
  return {"chord_length", name + " " + std::to_string(factor).substr(0, 4), [=](const Picture &p) {
            auto op = op_of<mvs_op_chord_length>(MVS_OP_CHORD_LENGTH);
            op.chord = id_of(p.model->valve.chords.get(), name);
            op.factor = factor;
            return perform(p, mvs::Operation(&op.op));
          }};
}

Operation chord_remove(const std::string &name) {
  return {"chord_remove", name, [=](const Picture &p) {
            auto op = op_of<mvs_op_chord_remove>(MVS_OP_CHORD_REMOVE);
            op.chord = id_of(p.model->valve.chords.get(), name);
            return perform(p, mvs::Operation(&op.op));
          }};
}

// To a place on a leaflet, from the first head or the second.
template <typename Op>
Operation tie(uint32_t kind, const char *name, const std::string &scallop, int head) {
  return {name, scallop, [=](const Picture &p) {
            auto op = op_of<Op>(kind);
            op.head = p.model->valve.heads[head].id;
            op.site = site_in(p.model->valve, scallop, 0.5, 0.85);
            return perform(p, mvs::Operation(&op.op));
          }};
}

Operation chord_transfer(const std::string &name, const std::string &scallop) {
  return {"chord_transfer", name + " to " + scallop, [=](const Picture &p) {
            auto op = op_of<mvs_op_chord_transfer>(MVS_OP_CHORD_TRANSFER);
            op.chord = id_of(p.model->valve.chords.get(), name);
            op.site = site_in(p.model->valve, scallop, 0.5, 0.85);
            return perform(p, mvs::Operation(&op.op));
          }};
}

Operation annulus_scale(const std::string &name, double factor, double ap) {
  return {"annulus_scale", name, [=](const Picture &p) {
            auto op = op_of<mvs_op_annulus_scale>(MVS_OP_ANNULUS_SCALE);
            op.factor = factor;
            op.ap = ap;
            return perform(p, mvs::Operation(&op.op));
          }};
}

Operation head_move(const std::string &name, int head, double z) {
  return {"head_move", name, [=](const Picture &p) {
            auto op = op_of<mvs_op_head_move>(MVS_OP_HEAD_MOVE);
            op.head = p.model->valve.heads[head].id;
            op.by[2] = z;
            return perform(p, mvs::Operation(&op.op));
          }};
}

// An operation with one value, the rest left to its defaults.
template <typename Op>
Operation with(uint32_t kind, const char *kind_name, const std::string &name, double Op::*field,
               double value) {
  return {kind_name, name, [=](const Picture &p) {
            auto op = op_of<Op>(kind);
            op.*field = value;
            return perform(p, mvs::Operation(&op.op));
          }};
}

Operation patch(const std::string &scallop) {
  return {"patch", scallop, [=](const Picture &p) {
            auto op = op_of<mvs_op_patch>(MVS_OP_PATCH);
            op.site = site_in(p.model->valve, scallop, 0.5, 0.5);
            return perform(p, mvs::Operation(&op.op));
          }};
}

std::vector<Operation> operations() {
  std::vector<Operation> all;
  for (const char *name : {"A2/7", "A2/2", "A1/7", "P2/2", "P2/6", "P1/3"}) {
    all.push_back(chord_length(name, 0.75));
    all.push_back(chord_remove(name));
  }
  all.push_back(chord_length("A2/7", 1.25));
  all.push_back(chord_length("P2/2", 0.90));
  for (const char *scallop : {"A2", "P2"}) {
    all.push_back(tie<mvs_op_chord_add>(MVS_OP_CHORD_ADD, "chord_add", scallop, 0));
    all.push_back(tie<mvs_op_neochord>(MVS_OP_NEOCHORD, "neochord", scallop, 1));
    all.push_back(patch(scallop));
  }
  all.push_back(chord_transfer("A2/2", "A1"));
  all.push_back(chord_transfer("P2/6", "A2"));
  all.push_back(annulus_scale("0.97", 0.97, 0));
  all.push_back(annulus_scale("0.90", 0.90, 0));
  all.push_back(annulus_scale("AP 0.85", 0, 0.85));
  all.push_back(head_move("2 mm up", 0, 2e-3));
  all.push_back(head_move("1 mm down", 1, -1e-3));
  all.push_back(with(MVS_OP_RING, "ring", "34", &mvs_op_ring::size, 34e-3));
  all.push_back(with(MVS_OP_RING, "ring", "30", &mvs_op_ring::size, 30e-3));
  all.push_back(with(MVS_OP_BAND, "band", "0.9", &mvs_op_band::factor, 0.9));
  all.push_back(with(MVS_OP_CLIP, "clip", "5 mm", &mvs_op_clip::width, 5e-3));
  all.push_back(with(MVS_OP_RESECT, "resect", "triangle", &mvs_op_resect::width, 8e-3));
  all.push_back(with(MVS_OP_RESECT, "resect", "quadrangle", &mvs_op_resect::base_width, 4e-3));
  return all;
}

Run close(const Options &options, const Model &model, const State &from) {
  Run run;
  for (int k = 0; k < options.repeat; ++k) {
    run.state = from;
    run.state.load = {MVS_SYSTOLE_PA, 1};
    // a new solver each time, so that no run warms up the next
    Solver solver(MVS_BACKEND_DEFAULT);
    run.stats = solver.settle(model, run.state, {}, {});
    run.wall_s.push_back(run.stats.wall_s);
  }
  std::sort(run.wall_s.begin(), run.wall_s.end());
  return run;
}

struct Row {
  std::string kind;
  double iterations, wall;  // again over open
  bool sound;               // both at rest, nothing intersects
};

double farthest(const State &a, const State &b) {
  double most = 0;
  for (size_t i = 0; i < a.x.size(); ++i) most = std::max(most, (a.x[i] - b.x[i]).norm());
  return most;
}

Row compare(const Options &options, const std::string &scene, const Picture &closed,
            const Operation &operation) {
  const Picture changed = operation.apply(closed).picture;
  const ModelPtr &model = changed.model;
  const Run open = close(options, *model, initial_state(*model));
  const Run again = close(options, *model, changed.state);
  const bool sound = open.stats.converged && again.stats.converged &&
                     find_intersections(again.state.x, model->valve.triangles).empty();
  const Row row{operation.kind, static_cast<double>(again.stats.iterations) / open.stats.iterations,
                again.median_s() / open.median_s(), sound};
  const std::string title = operation.kind + " " + operation.name;
  std::printf("%-6s %-22s %5u %5u %6.2f  %8.4f %8.4f %6.2f  %6.2f  %s\n", scene.c_str(),
              title.c_str(), open.stats.iterations, again.stats.iterations, row.iterations,
              open.median_s(), again.median_s(), row.wall, farthest(open.state, again.state) * 1e3,
              sound ? "" : "NOT AT REST");
  std::fflush(stdout);
  return row;
}

double median(std::vector<Row> rows, double Row::*of) {
  std::sort(rows.begin(), rows.end(), [=](const Row &a, const Row &b) { return a.*of < b.*of; });
  return rows[rows.size() / 2].*of;
}

// The median of each kind of operation.
void tell_kinds(const std::vector<Row> &rows) {
  std::map<std::string, std::vector<Row>> kinds;
  for (const Row &row : rows) kinds[row.kind].push_back(row);
  for (const auto &[kind, of_kind] : kinds) {
    std::printf("%-14s %3zu: %.2f of the iterations, %.2f of the time\n", kind.c_str(),
                of_kind.size(), median(of_kind, &Row::iterations), median(of_kind, &Row::wall));
  }
}

int run(int argc, char **argv) {
  Options options;
  std::vector<std::string> names;
  for (const auto &scene : scenes) names.push_back(scene.first);
  CLI::App app("Times closing again after an operation beside closing from open.", "bench_reclose");
  app.add_option("--scenes", options.scenes, "S 425, M 1700, L 6800 vertices")
      ->capture_default_str()
      ->check(CLI::IsMember(names));
  app.add_option("--repeat", options.repeat, "runs of each")
      ->capture_default_str()
      ->check(CLI::PositiveNumber);
  CLI11_PARSE(app, argc, argv);

  std::printf("%-6s %-22s %5s %5s %6s  %8s %8s %6s  %6s\n", "scene", "operation", "open", "again",
              "ratio", "open s", "again s", "ratio", "mm");
  std::vector<Row> rows;
  for (const std::string &scene : options.scenes) {
    const ModelPtr model = make_model(make_scene(scenes.at(scene)));
    const Picture closed{model, close(options, *model, initial_state(*model)).state};
    for (const Operation &operation : operations()) {
      rows.push_back(compare(options, scene, closed, operation));
    }
  }
  tell_kinds(rows);
  std::printf("median of %zu operations: %.2f of the iterations, %.2f of the time\n", rows.size(),
              median(rows, &Row::iterations), median(rows, &Row::wall));
  const bool sound = std::all_of(rows.begin(), rows.end(), [](const Row &r) { return r.sound; });
  return sound ? 0 : 1;
}

}  // namespace

int main(int argc, char **argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception &error) {
    std::fprintf(stderr, "bench_reclose: %s\n", error.what());
    return 1;
  }
}
