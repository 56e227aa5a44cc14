// Cost of closing a valve from open to one residual: leaflets of springs and of membrane, for each
// solver and phase.
//
//   bench_closure                    scenes S, M, L with newton; S also with the founding paper's
//                                    explicit method, at its largest stable step and best damping
//   bench_closure --scenes XL --leaflets membrane
//   bench_closure --explicit M       minutes; --dt and --damping spare it the search
//   bench_closure --relaxation S M   dynamic relaxation at its best settings, with viscous and with
//                                    kinetic damping; springs and membrane
//   bench_closure --scenes L XL --leaflets spring --workers 1 2
//                                    newton with so many threads: wall seconds, and "shared", the
//                                    share of the CPU time in loops that they share
//   bench_closure --csv FILE         also as a table
//
// CPU seconds are medians of the runs; those of a phase are its share of the wall time, "other" is
// the time in no phase. "rms" and "max" are distances of the closed surface from that of newton
// at a residual of 1e-7 N.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <exception>
#include <map>
#include <string>
#include <vector>

#include "tests/bench/founding.h"
#include "tests/bench/relaxation/relaxed_closing.h"
#include "tests/bench/table.h"

using namespace bench;

namespace {

struct Options {
  std::vector<std::string> scenes = {"S", "M", "L"}, leaflets = {"spring", "membrane"};
  std::vector<std::string> solvers = {"newton"}, explicit_scenes = {"S"};
  std::vector<std::string> relaxed_scenes = {"S"};
  std::vector<uint32_t> workers = {1};
  double residual = rest_residual, dt = 0, damping = 0;
  int repeat = 3;
  std::string csv;
};

struct Row {
  Case of;
  Closing closing;
  double shared = 0;
};

// The reference of closed shapes: newton's at a residual of 1e-7 N, where only rounding is left.
class Converged {
 public:
  mvs_comparison distance_of(const Row &row) {
    std::string &shape = shapes_[row.of.scene + row.of.leaflet];
    if (shape.empty()) {
      shape = close({row.of.scene, row.of.leaflet, "newton", 1e-7, 0, 0, iterations}, 1).closed;
    }
    return distance(row.closing.closed, shape);
  }

 private:
  static constexpr uint32_t iterations = 100;  // at most
  std::map<std::string, std::string> shapes_;
};

std::vector<std::string> columns() {
  std::vector<std::string> names = {"scene",    "vertices",  "leaflet ", "solver  ", "steps",
                                    "factored", "orderings", "broad",    "passes",   "linear",
                                    "workers",  "shared",    "cpu s",    "wall s",   "residual N",
                                    "at rest",  "crossings", "hole mm2", "rms mm",   "max mm"};
  for (const std::string &phase : phase_names) names.push_back(phase + " ms");
  names.push_back("other ms");
  return names;
}

void tell(Table &table, const Row &row, Converged &converged) {
  const mvs_stats &s = row.closing.stats;
  const mvs_profile &profile = row.closing.profile;
  std::vector<Cell> cells = {row.of.scene,
                             row.closing.vertices,
                             row.of.leaflet,
                             row.of.solver,
                             s.iterations,
                             profile.factorisations,
                             profile.orderings,
                             profile.broad_phases,
                             profile.passes,
                             profile.linear_iterations,
                             std::max(row.of.workers, 1u),
                             row.shared,
                             row.closing.cpu(),
                             row.closing.wall(),
                             s.residual,
                             row.closing.at_rest(),
                             row.closing.measures.intersections,
                             row.closing.measures.regurgitant_orifice_area * 1e6};
  const mvs_comparison off = converged.distance_of(row);
  cells.push_back(off.surface_rms * 1e3);
  cells.push_back(off.surface_max * 1e3);
  for (size_t k = 0; k < phase_names.size(); ++k) cells.push_back(row.closing.phase(k) * 1e3);
  cells.push_back(row.closing.other() * 1e3);
  table.row(cells);
}

// The median ratio of the wall times of runs beside each other: the first number of workers over
// each other one.
void tell_speedups(const std::vector<Case> &cases, const std::vector<Closing> &closings) {
  for (size_t k = 1; k < cases.size(); ++k) {
    std::vector<double> ratios;
    for (size_t run = 0; run < closings[k].wall_s.size(); ++run) {
      ratios.push_back(closings[0].wall_s[run] / closings[k].wall_s[run]);
    }
    std::printf("%s, %s: %u workers are %.2f times as fast as %u (wall), same bits: %s\n",
                cases[k].scene.c_str(), cases[k].leaflet.c_str(), cases[k].workers, median(ratios),
                cases[0].workers, closings[k].closed == closings[0].closed ? "yes" : "NO");
  }
}

std::vector<Row> run_all(const Options &options) {
  Table table(columns(), options.csv);
  std::vector<Row> rows;
  Converged converged;
  const auto add = [&](const Row &row) {
    tell(table, row, converged);
    rows.push_back(row);
  };
  for (const std::string &scene : options.scenes) {
    for (const std::string &leaflet : options.leaflets) {
      for (const std::string &solver : options.solvers) {
        std::vector<Case> cases(options.workers.size(), {scene, leaflet, solver, options.residual});
        for (size_t k = 0; k < cases.size(); ++k) cases[k].workers = options.workers[k];
        const std::vector<Closing> closings = close_in_turn(cases, options.repeat);
        for (size_t k = 0; k < cases.size(); ++k) {
          add({cases[k], closings[k], cases[k].workers > 1 ? shared_part(cases[k]) : 0});
        }
        tell_speedups(cases, closings);
      }
    }
  }
  for (const std::string &scene : options.explicit_scenes) {
    const Founding best = close_founding(
        {scene, "spring", "explicit", options.residual, options.dt, options.damping});
    add({best.taken, best.closing});
  }
  std::string settings;
  for (const std::string &scene : options.relaxed_scenes) {
    for (const std::string &leaflet : options.leaflets) {
      for (const Damping damping : {Damping::viscous, Damping::kinetic}) {
        const Case of{scene, leaflet, damping_names.at(damping), options.residual};
        const Relaxed best = close_relaxed(of, damping);
        add({of, best.closing});
        settings.append(scene).append(", ").append(leaflet).append(": ");
        settings.append(words_of(best)).append("\n");
      }
    }
  }
  std::printf("%s", settings.c_str());
  return rows;
}

// The ratio of explicit and relaxation to newton, where both ran on a scene and both converged.
void tell_ratios(const std::vector<Row> &rows) {
  for (const Row &slow : rows) {
    if (solver_names.count(slow.of.solver) > 0 && slow.of.solver != "explicit") continue;
    const std::string scene = slow.of.scene + ", " + slow.of.leaflet;
    if (slow.of.solver == "explicit") {
      std::printf("%s: the founding method took steps of %.3g us and a damping of %.3g /s\n",
                  scene.c_str(), slow.of.dt * 1e6, slow.of.damping);
    }
    for (const Row &fast : rows) {
      if (fast.of.solver != "newton" || slow.of.scene != fast.of.scene) continue;
      if (fast.of.leaflet != slow.of.leaflet) continue;
      if (slow.closing.at_rest() && fast.closing.at_rest()) {
        std::printf("%s: %s takes %.1f times as long as newton to the same residual\n",
                    scene.c_str(), slow.of.solver.c_str(), slow.closing.cpu() / fast.closing.cpu());
      } else {
        std::printf("%s: no ratio of %s to newton: one of the two did not reach the residual\n",
                    scene.c_str(), slow.of.solver.c_str());
      }
    }
  }
}

void add_options(CLI::App &app, Options &options) {
  app.add_option("--scenes", options.scenes, "S 425, M 1700, L 6800, XL 27000 vertices")
      ->capture_default_str()
      ->check(CLI::IsMember(keys(scene_vertices)));
  app.add_option("--leaflets", options.leaflets, "of these scenes")
      ->capture_default_str()
      ->check(CLI::IsMember({"spring", "membrane"}));
  app.add_option("--solvers", options.solvers, "for these scenes")
      ->capture_default_str()
      ->check(CLI::IsMember(keys(solver_names)));
  app.add_option("--explicit", options.explicit_scenes, "scenes for the founding method, too")
      ->capture_default_str()
      ->check(CLI::IsMember(keys(scene_vertices)));
  app.add_option("--relaxation", options.relaxed_scenes, "scenes for dynamic relaxation, too")
      ->capture_default_str()
      ->check(CLI::IsMember(keys(scene_vertices)));
  app.add_option("--dt", options.dt, "s, of the founding method [searched]")
      ->check(CLI::PositiveNumber);
  app.add_option("--damping", options.damping, "1/s, of the founding method [searched]")
      ->check(CLI::PositiveNumber);
  app.add_option("--residual", options.residual, "N, at which a valve is at rest")
      ->capture_default_str()
      ->check(CLI::PositiveNumber);
  app.add_option("--repeat", options.repeat, "runs of each, explicit but once")
      ->capture_default_str()
      ->check(CLI::PositiveNumber);
  app.add_option("--workers", options.workers, "threads, in turn")
      ->capture_default_str()
      ->check(CLI::Range(1, MVS_MAX_WORKERS));
  app.add_option("--csv", options.csv, "file to write the table to");
}

int run(int argc, char **argv) {
  Options options;
  CLI::App app("Times the closure of generated valves, solver against solver.", "bench_closure");
  add_options(app, options);
  CLI11_PARSE(app, argc, argv);
  // naming solvers runs only those
  if (app.count("--solvers") > 0 && app.count("--explicit") == 0) options.explicit_scenes.clear();
  if (app.count("--workers") > 0 && app.count("--explicit") == 0) options.explicit_scenes.clear();
  if (app.count("--workers") > 0 && app.count("--relaxation") == 0) options.relaxed_scenes.clear();
  if (app.count("--solvers") > 0 && app.count("--relaxation") == 0) options.relaxed_scenes.clear();
  tell_ratios(run_all(options));
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
