// Cost of a build: a surface becomes a valve, by stage.
//
//   bench_import                        parametric leaflets of 1,100 and 5,000 triangles
//   bench_import --surface open.stl --unit mm
//   bench_import --fit                  also a fit to the closed surface of other chord lengths
//   bench_import --workers 2            closures of a fit and of the leak run at the same time
//   bench_import --csv FILE
//
// Columns: wall seconds, CPU seconds of the whole and of each stage (build_valve.h), of the run
// with the least CPU time, and the iterations of the three closures for the leak. The surface of a
// fit is that of the same valve with lengths of groups of chordae between 0.93 and 1.06 times as
// long, closed.
#include <mvs/valve.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <map>
#include <string>
#include <vector>

#include "anatomy/parametric.h"
#include "formats/surface/surface_file.h"
#include "patient/build_valve.h"
#include "patient/fit/fit_to_closed.h"
#include "tests/bench/clock.h"
#include "tests/bench/table.h"

using namespace mvs::core;

namespace {

struct Options {
  std::string surface, unit, csv;
  double edge = 0;  // mm
  int repeat = 3;
  bool fit = false;
  uint32_t workers = 1;
};

struct Case {
  std::string name;
  PatientSurface surface;
};

const std::vector<std::string> stages = {"clean",  "mid",     "untangle", "leaflets", "remesh",
                                         "tissue", "chordae", "fit",      "leak"};

Case parametric(const char *name, uint32_t vertices) {
  mvs_parametric_desc desc = {};
  desc.struct_size = sizeof desc;
  desc.vertices = vertices;
  const Valve valve = make_parametric_valve(desc);
  Case made{name, {}};
  made.surface.triangles = valve.triangles;
  uint32_t nodes = 0;
  for (const Tri &t : valve.triangles.get())
    nodes = std::max({nodes, t[0] + 1, t[1] + 1, t[2] + 1});
  made.surface.points.assign(valve.rest.begin(), valve.rest.begin() + nodes);
  for (const Head &head : valve.heads) made.surface.tips.push_back(valve.rest[head.node]);
  return made;
}

Case from_file(const Options &options) {
  std::ifstream in(options.surface, std::ios::binary);
  if (!in) throw std::runtime_error(options.surface + " cannot be read");
  const std::string bytes{std::istreambuf_iterator<char>(in), {}};
  const std::map<std::string, LengthUnit> units = {
      {"", LengthUnit::unknown}, {"m", LengthUnit::m}, {"mm", LengthUnit::mm}};
  SurfaceFileOptions how;
  how.unit = units.at(options.unit);
  SurfaceFile file = read_surface_file(bytes, options.surface, how);
  Case made{"file", {}};
  made.surface.points = std::move(file.points);
  made.surface.triangles = std::move(file.triangles);
  return made;
}

// Gives a case the closed surface of its own valve with other chord lengths.
void add_closed(const BuildSettings &settings, Case &of) {
  const BuiltValve built = build_valve(of.surface, settings, {});
  Valve valve = built.model->valve;
  const std::vector<ChordGroup> groups = chord_groups(*built.model, ChordGrouping::kinds);
  std::vector<double> factor;
  for (size_t k = 0; k < groups.size(); ++k)
    factor.push_back(k % 3 == 0 ? 0.93 : k % 3 == 1 ? 1.06 : 1);
  scale_groups(valve, groups, factor);
  Solver solver(Backend::fastest);
  const ClosedValve closed = close_open(solver, make_model(std::move(valve)), systolic_pressure);
  of.surface.closed_triangles = built.model->valve.triangles;
  of.surface.closed_points = closed.state.x;
}

// CPU seconds of each stage of one build; the whole is their sum.
std::map<std::string, double> time_stages(const Case &of, BuildSettings settings,
                                          BuiltValve &built) {
  std::map<std::string, double> spent;
  std::string stage;
  double since = bench::cpu_now();
  const auto enter = [&](const char *next) {
    const double now = bench::cpu_now();
    if (!stage.empty()) spent[stage] += now - since;
    stage = next;
    since = now;
  };
  settings.on_stage = enter;
  built = build_valve(of.surface, settings, {});
  enter("");
  return spent;
}

void add_row(const Options &options, const Case &of, bench::Table &table) {
  Workers workers(options.workers);
  BuildSettings settings;
  settings.edge = options.edge * 1e-3;
  settings.workers = &workers;
  Case with_closed = of;
  if (options.fit) add_closed(settings, with_closed);
  std::map<std::string, double> best;
  double best_total = HUGE_VAL, best_wall = 0;
  BuiltValve built;
  for (int k = 0; k < options.repeat; ++k) {
    std::map<std::string, double> spent;
    const double wall =
        bench::timed([&] { spent = time_stages(with_closed, settings, built); }).wall;
    double total = 0;
    for (const auto &[stage, seconds] : spent) total += seconds;
    if (total >= best_total) continue;
    best_total = total;
    best_wall = wall;
    best = spent;
  }
  std::vector<bench::Cell> cells = {of.name, of.surface.triangles.size(),
                                    built.model->topology.node_kind.size(), best_wall, best_total};
  for (const std::string &stage : stages) cells.emplace_back(best[stage]);
  cells.emplace_back(built.leak.iterations[0]);
  cells.emplace_back(built.leak.iterations[1]);
  cells.emplace_back(built.leak.iterations[2]);
  table.row(cells);
}

int run(int argc, char **argv) {
  Options options;
  CLI::App app("Times the build of a valve from a surface, stage by stage.", "bench_import");
  app.add_option("--surface", options.surface, "a surface file instead of parametric leaflets");
  app.add_option("--unit", options.unit, "its unit")->check(CLI::IsMember({"m", "mm"}));
  app.add_option("--edge", options.edge, "sides of the new triangles, mm");
  app.add_option("--repeat", options.repeat, "runs of each")
      ->capture_default_str()
      ->check(CLI::PositiveNumber);
  app.add_flag("--fit", options.fit, "with a fit to a closed surface");
  app.add_option("--workers", options.workers, "threads that close variants at the same time")
      ->capture_default_str()
      ->check(CLI::Range(1u, Workers::most));
  app.add_option("--csv", options.csv, "file to write the table to");
  CLI11_PARSE(app, argc, argv);
  std::vector<std::string> columns = {"surface ", "triangles", "nodes", "wall s", "CPU s"};
  columns.insert(columns.end(), stages.begin(), stages.end());
  for (const char *name : {"it 0.9", "it 1", "it 1.1"}) columns.emplace_back(name);
  bench::Table table(columns, options.csv);
  if (!options.surface.empty()) {
    add_row(options, from_file(options), table);
    return 0;
  }
  add_row(options, parametric("1k", 600), table);
  add_row(options, parametric("5k", 2600), table);
  return 0;
}

}  // namespace

int main(int argc, char **argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception &error) {
    std::fprintf(stderr, "bench_import: %s\n", error.what());
    return 1;
  }
}
