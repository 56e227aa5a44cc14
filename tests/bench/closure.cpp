// How long a valve takes to close, from open to rest at one residual, with each solver side by
// side.
//
//   bench_closure                    scenes S, M, L with newton; S also with the founding paper's
//                                    explicit method; prints the ratio of the two
//   bench_closure --csv FILE         also as a table: scene,vertices,solver,...
#include <mvs/mvs.hpp>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

const std::map<std::string, uint32_t> solvers = {{"newton", MVS_SOLVER_NEWTON},
                                                 {"implicit", MVS_SOLVER_IMPLICIT},
                                                 {"explicit", MVS_SOLVER_EXPLICIT}};
const std::map<std::string, uint32_t> scene_vertices = {{"S", 425}, {"M", 1700}, {"L", 6800}};

struct Options {
  std::vector<std::string> scenes = {"S", "M", "L"};
  std::vector<std::string> solvers = {"newton"};
  std::vector<std::string> explicit_scenes = {"S"};
  double residual = 1e-4;
  int repeat = 3;
  std::string csv;
};

struct Row {
  std::string scene, solver;
  size_t vertices = 0;
  mvs_stats stats = {};
  mvs_measures measures = {};
  std::vector<double> wall_s;  // sorted

  double median_s() const { return wall_s[wall_s.size() / 2]; }
};

size_t leaflet_vertices(const mvs::Snapshot &valve) {
  const auto kinds = valve.view<uint8_t>(MVS_NODE_KIND);
  return static_cast<size_t>(std::count_if(kinds.begin(), kinds.end(), [](uint8_t kind) {
    return kind == MVS_NODE_IS_LEAFLET || kind == MVS_NODE_IS_ANNULUS;
  }));
}

// Closes one freshly made valve; a new simulator each time, so that no run warms up the next.
void close_once(const Options &options, Row &row) {
  mvs::Sim sim;
  mvs_parametric_desc valve = {};
  valve.vertices = scene_vertices.at(row.scene);
  sim.generate(valve);
  sim.set_load(MVS_SYSTOLE_PA);

  mvs_settle_options settle = {};
  settle.solver = solvers.at(row.solver);
  settle.residual = options.residual;
  const auto start = std::chrono::steady_clock::now();
  row.stats = sim.settle(settle);
  row.wall_s.push_back(
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());

  const mvs::Snapshot closed = sim.snapshot();
  row.vertices = leaflet_vertices(closed);
  row.measures = closed.measure();
}

void print(const Row &row) {
  std::printf("%-5s %8zu  %-9s %9u  %10.4f  %10.4f  %9.1e  %-9s %5u  %8.1f\n", row.scene.c_str(),
              row.vertices, row.solver.c_str(), row.stats.iterations, row.median_s(),
              row.wall_s.back(), row.stats.residual, row.stats.converged ? "yes" : "NO",
              row.measures.intersections, row.measures.regurgitant_orifice_area * 1e6);
  std::fflush(stdout);
}

Row run(const Options &options, const std::string &scene, const std::string &solver) {
  Row row;
  row.scene = scene;
  row.solver = solver;
  // the explicit method takes minutes, so that once must do
  const int repeat = solver == "explicit" ? 1 : options.repeat;
  for (int i = 0; i < repeat; ++i) close_once(options, row);
  std::sort(row.wall_s.begin(), row.wall_s.end());
  print(row);
  return row;
}

std::vector<Row> run_all(const Options &options) {
  std::printf("%-5s %8s  %-9s %9s  %10s  %10s  %9s  %-9s %5s  %8s\n", "scene", "vertices", "solver",
              "steps", "median s", "max s", "residual N", "converged", "cross", "hole mm2");
  std::vector<Row> rows;
  for (const std::string &scene : options.scenes) {
    for (const std::string &solver : options.solvers) rows.push_back(run(options, scene, solver));
  }
  for (const std::string &scene : options.explicit_scenes) {
    rows.push_back(run(options, scene, "explicit"));
  }
  return rows;
}

// Explicit over Newton, where both ran on a scene and both came to rest.
void print_ratios(const std::vector<Row> &rows) {
  for (const Row &slow : rows) {
    for (const Row &fast : rows) {
      if (slow.solver != "explicit" || fast.solver != "newton" || slow.scene != fast.scene)
        continue;
      if (slow.stats.converged && fast.stats.converged) {
        std::printf("%s: explicit takes %.0f times as long as newton to the same residual\n",
                    slow.scene.c_str(), slow.median_s() / fast.median_s());
      } else {
        std::printf("%s: no ratio, as one of the two did not reach the residual\n",
                    slow.scene.c_str());
      }
    }
  }
}

void write_csv(const std::vector<Row> &rows, const std::string &path) {
  std::ofstream file(path);
  file << "scene,vertices,solver,iterations,s_median,s_max,residual_N,converged,intersections,"
          "orifice_mm2\n";
  for (const Row &row : rows) {
    file << row.scene << ',' << row.vertices << ',' << row.solver << ',' << row.stats.iterations
         << ',' << row.median_s() << ',' << row.wall_s.back() << ',' << row.stats.residual << ','
         << row.stats.converged << ',' << row.measures.intersections << ','
         << row.measures.regurgitant_orifice_area * 1e6 << '\n';
  }
  if (!file.flush()) throw std::runtime_error("could not write " + path);
}

std::vector<std::string> keys(const std::map<std::string, uint32_t> &map) {
  std::vector<std::string> names;
  names.reserve(map.size());
  for (const auto &[name, value] : map) names.push_back(name);
  return names;
}

void add_options(CLI::App &app, Options &options) {
  app.add_option("--scenes", options.scenes, "S 425, M 1700, L 6800 vertices")
      ->capture_default_str()
      ->check(CLI::IsMember(keys(scene_vertices)));
  app.add_option("--solvers", options.solvers, "for these scenes")
      ->capture_default_str()
      ->check(CLI::IsMember(keys(solvers)));
  app.add_option("--explicit", options.explicit_scenes, "scenes for the explicit method, too")
      ->capture_default_str()
      ->check(CLI::IsMember(keys(scene_vertices)));
  app.add_option("--residual", options.residual, "N, at which a valve is at rest")
      ->capture_default_str()
      ->check(CLI::PositiveNumber);
  app.add_option("--repeat", options.repeat, "runs of each, explicit but once")
      ->capture_default_str()
      ->check(CLI::PositiveNumber);
  app.add_option("--csv", options.csv, "file to write the table to");
}

int run(int argc, char **argv) {
  Options options;
  CLI::App app("Times the closure of generated valves, solver against solver.", "bench_closure");
  add_options(app, options);
  CLI11_PARSE(app, argc, argv);
  // asking for solvers by name asks for no other one
  if (app.count("--solvers") > 0 && app.count("--explicit") == 0) options.explicit_scenes.clear();
  const std::vector<Row> rows = run_all(options);
  print_ratios(rows);
  if (!options.csv.empty()) write_csv(rows, options.csv);
  return 0;
}

}  // namespace

int main(int argc, char **argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception &error) {
    std::fprintf(stderr, "bench_closure: %s\n", error.what());
    return 1;
  }
}
