// Cost of closing again after one surgical operation, beside closing the same valve from open.
//
//   bench_reclose                    scenes S, M and two sick valves; every operation on each
//   bench_reclose --scenes S --repeat 1
//   bench_reclose --margins          settles that also find the margins of stability
//   bench_reclose --csv FILE
//
// A valve is closed, then operated on. The changed valve is closed twice: from open, and from where
// the operation left it. Columns: iterations and CPU time (the median of the runs) of both, their
// ratio, the CPU time of the measures of the closed shape (in a new snapshot, all of them), and how
// far apart the two closed shapes are, RMS and at most. Every rest is proved to be stable; its
// margins, which are no part of shape and figures, are left out (MVS_SETTLE_NO_MARGINS). The last
// lines are medians: the goals are a quarter of the time, 0.1 mm, and 15 ms (S) and 60 ms (M) from
// the operation to shape and figures.
//
// Exit code 1: a valve did not come to rest, or meets itself.
#include <mvs/sim.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "anatomy/parametric.h"
#include "geometry/intersect.h"
#include "session/snapshot.h"
#include "solve/static/mesh_hierarchy.h"
#include "tests/bench/closing.h"
#include "tests/bench/operations.h"
#include "tests/bench/table.h"

using namespace mvs::core;

namespace {

struct Scene {
  const char *size;
  double annulus_scale;
  bool long_strut;
};
const std::map<std::string, Scene> scenes = {{"S", {"S", 1, false}},
                                             {"M", {"M", 1, false}},
                                             {"L", {"L", 1, false}},
                                             {"sickS", {"S", 1.15, true}},
                                             {"sickM", {"M", 1.15, true}}};

struct Options {
  std::vector<std::string> scenes = {"S", "sickS", "M", "sickM"};
  int repeat = 3;
  bool margins = false;
  std::string only, csv;
};

struct Run {
  SolveStats stats;
  State state;
  std::vector<double> cpu_s;
  double median_s() const { return bench::median(cpu_s); }
};

Valve make_scene(const Scene &scene) {
  mvs_parametric_desc desc = {};
  desc.shape = MVS_SHAPE_FOUNDING;
  desc.struct_size = sizeof desc;
  desc.vertices = bench::scene_vertices.at(scene.size);
  desc.annulus_scale = scene.annulus_scale;
  Valve valve = make_parametric_valve(desc);
  for (Chord &c : valve.chords) {
    if (scene.long_strut && c.name == "A2/7") c.rest_length *= 1.25;
  }
  return valve;
}

Run close(const Options &options, const Model &model, const State &from) {
  Run run;
  SolveOptions how;
  how.margins = options.margins;
  for (int k = 0; k < options.repeat; ++k) {
    run.state = from;
    run.state.load = {MVS_SYSTOLE_PA, 1};
    // a new solver each time, so that no run starts from another's cached data
    Solver solver(Backend::fastest);
    const auto settle = [&] {
      run.stats = settle_with_mesh_hierarchy(solver, model, run.state, how, {});
    };
    run.cpu_s.push_back(bench::timed(settle).cpu);
  }
  return run;
}

struct Row {
  std::string kind, size;   // "clip", "S"
  double iterations, time;  // of closing again over closing from open
  double figures_s;         // closing again, then measuring
  double rms_mm, farthest_mm;
  bool sound;  // both at rest, nothing intersects
};

// The CPU seconds of the measures of a shape: the median of runs with a new snapshot each.
double measuring_s(const Options &options, const ModelState &shape) {
  std::vector<double> cpu_s;
  for (int k = 0; k < options.repeat; ++k) {
    const SnapshotPtr snapshot = make_snapshot({shape, {}});
    cpu_s.push_back(bench::timed([&] { snapshot->measures(); }).cpu);
  }
  return bench::median(cpu_s);
}

// RMS and largest distance of the nodes of two states.
void measure_distance(const State &a, const State &b, Row &row) {
  double most = 0, sum = 0;
  for (size_t i = 0; i < a.x.size(); ++i) {
    const double apart = (a.x[i] - b.x[i]).norm();
    most = std::max(most, apart);
    sum += apart * apart;
  }
  row.farthest_mm = most * 1e3;
  row.rms_mm = std::sqrt(sum / static_cast<double>(a.x.size())) * 1e3;
}

Row compare(const Options &options, const std::string &scene, const ModelState &closed,
            const bench::Operation &operation, bench::Table &table) {
  const ModelState changed = operation.apply(closed).current;
  const ModelPtr &model = changed.model;
  const Run open = close(options, *model, initial_state(*model));
  const Run again = close(options, *model, changed.state);
  const bool sound = open.stats.converged && again.stats.converged &&
                     find_intersections(again.state.x, model->valve.triangles).empty();
  const double measuring = measuring_s(options, {model, again.state});
  Row row{operation.kind,
          scene.substr(scene.size() - 1),
          static_cast<double>(again.stats.iterations) / open.stats.iterations,
          again.median_s() / open.median_s(),
          again.median_s() + measuring,
          0,
          0,
          sound};
  measure_distance(open.state, again.state, row);
  table.row({scene, operation.kind + " " + operation.name, open.stats.iterations,
             again.stats.iterations, row.iterations, open.median_s() * 1e3, again.median_s() * 1e3,
             row.time, measuring * 1e3, row.rms_mm, row.farthest_mm, sound});
  return row;
}

double median(const std::vector<Row> &rows, double Row::*of) {
  std::vector<double> values;
  values.reserve(rows.size());
  for (const Row &row : rows) values.push_back(row.*of);
  return bench::median(values);
}

// The median of each kind of operation.
void tell_kinds(const std::vector<Row> &rows) {
  std::map<std::string, std::vector<Row>> kinds;
  for (const Row &row : rows) kinds[row.kind].push_back(row);
  for (const auto &[kind, of_kind] : kinds) {
    std::printf("%-14s %3zu: %.2f of the iterations, %.2f of the time\n", kind.c_str(),
                of_kind.size(), median(of_kind, &Row::iterations), median(of_kind, &Row::time));
  }
}

void tell_all(const std::vector<Row> &rows) {
  const auto same =
      std::count_if(rows.begin(), rows.end(), [](const Row &row) { return row.rms_mm <= 0.1; });
  std::printf(
      "median of %zu operations: %.2f of the iterations, %.2f of the time, %.3f mm apart (RMS); "
      "within 0.1 mm: %td\n",
      rows.size(), median(rows, &Row::iterations), median(rows, &Row::time),
      median(rows, &Row::rms_mm), same);
}

// The time that a surgeon waits from the operation to the closed shape with its figures.
void tell_waiting(const std::vector<Row> &rows) {
  std::map<std::string, std::vector<Row>> sizes;
  for (const Row &row : rows) sizes[row.size].push_back(row);
  for (const auto &[size, of_size] : sizes) {
    std::printf("%s: shape and figures after %.1f ms of CPU, median of %zu operations\n",
                size.c_str(), median(of_size, &Row::figures_s) * 1e3, of_size.size());
  }
}

int run(int argc, char **argv) {
  Options options;
  CLI::App app("Times closing again after an operation beside closing from open.", "bench_reclose");
  app.add_option("--scenes", options.scenes, "S 425, M 1700, L 6800 vertices")
      ->capture_default_str()
      ->check(CLI::IsMember(bench::keys(scenes)));
  app.add_option("--repeat", options.repeat, "runs of each")
      ->capture_default_str()
      ->check(CLI::PositiveNumber);
  app.add_flag("--margins", options.margins, "margins of stability as well");
  app.add_option("--only", options.only, "this kind of operation: \"clip\"");
  app.add_option("--csv", options.csv, "file to write the table to");
  CLI11_PARSE(app, argc, argv);

  bench::Table table(
      {"scene ", "operation             ", "steps open", "steps again", "ratio", "open ms",
       "again ms", "ratio ms", "figures ms", "rms mm", "most mm", "sound"},
      options.csv);
  std::vector<Row> rows;
  for (const std::string &scene : options.scenes) {
    const ModelPtr model = make_model(make_scene(scenes.at(scene)));
    const ModelState closed{model, close(options, *model, initial_state(*model)).state};
    for (const bench::Operation &operation : bench::operations()) {
      if (!options.only.empty() && options.only != operation.kind) continue;
      rows.push_back(compare(options, scene, closed, operation, table));
    }
  }
  if (rows.empty()) throw std::runtime_error("no operation is called " + options.only);
  tell_kinds(rows);
  tell_all(rows);
  tell_waiting(rows);
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
