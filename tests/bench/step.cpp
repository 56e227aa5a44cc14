// What a live step costs: a minute of scripted play at 1 kHz, every step timed.
//
//   bench_step                       scenes S and M, 60 s of simulated time each
//   bench_step --seconds 2 --scenes S
//   bench_step --csv FILE            also as a table, one row a scene and phase of the play
//
// The play: a valve closes under systole, beats, a chord is shortened, a ring sewn in, the valve
// beats again, a chord is cut, all is undone, the load goes and comes back, and the valve is left
// alone. Times are CPU times of the thread (CLOCK_THREAD_CPUTIME_ID), so that other work on the
// machine shows less. "asleep" is the share of steps that did nothing but time; "lowered" counts
// steps that gave something up for their budget: of the linear solution, of the way; "cross" is the
// largest number of crossing triangle pairs, exact, at samples. "resting / active" compares the
// medians of both kinds of steps. "explicit" is the median step of the founding paper's method, 8
// us long, on the closed valve: 125 of them make one of ours.
#include <mvs/mvs.hpp>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <functional>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

const std::map<std::string, uint32_t> scene_vertices = {{"S", 425}, {"M", 1700}};
constexpr double dt = 1e-3;
constexpr int explicit_steps = 200;
constexpr int samples = 20;  // of crossings, in a phase

struct Options {
  std::vector<std::string> scenes = {"S", "M"};
  double seconds = 60;
  uint32_t budget = 0;
  std::string csv;
};

double cpu_now() {
  timespec now = {};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

struct Row {
  std::string scene, phase;
  std::vector<double> active, resting;  // seconds a step
  size_t lowered_linear = 0, lowered_step = 0, broad = 0, orderings = 0;
  uint32_t crossings = 0;

  size_t steps() const { return active.size() + resting.size(); }
  void add(const Row &other) {
    active.insert(active.end(), other.active.begin(), other.active.end());
    resting.insert(resting.end(), other.resting.begin(), other.resting.end());
    lowered_linear += other.lowered_linear;
    lowered_step += other.lowered_step;
    broad += other.broad;
    orderings += other.orderings;
    crossings = std::max(crossings, other.crossings);
  }
};

double percentile(std::vector<double> of, double share) {
  if (of.empty()) return 0;
  std::sort(of.begin(), of.end());
  const auto at = static_cast<size_t>(std::ceil(share * static_cast<double>(of.size())));
  return of[std::min(of.size() - 1, at > 0 ? at - 1 : 0)];
}

std::vector<double> all_of(const Row &row) {
  std::vector<double> all = row.active;
  all.insert(all.end(), row.resting.begin(), row.resting.end());
  return all;
}

// One phase of the play: what is done at its start, and before each of its steps.
struct Phase {
  std::string name;
  std::function<void(mvs::Sim &)> begin;
  std::function<void(mvs::Sim &, int step)> during = {};
};

void beat(mvs::Sim &sim, int step) {
  if (step % 20 == 0) sim.set_load(MVS_SYSTOLE_PA * (0.8 + 0.3 * std::sin(2e-3 * M_PI * step)));
}

mvs_id chord_of(const mvs::Sim &sim, const std::string &name) {
  return sim.snapshot().find(MVS_PART_CHORD, name).id;
}

void shorten(mvs::Sim &sim) {
  mvs_op_chord_length op = {};
  op.chord = chord_of(sim, "P2/1");
  op.factor = 0.85;
  sim.apply(op);
}

void sew_ring(mvs::Sim &sim) {
  mvs_op_ring op = {};
  op.size = 0.034;
  sim.apply(op);
}

void cut_chord(mvs::Sim &sim) {
  mvs_op_chord_remove op = {};
  op.chord = chord_of(sim, "A2/1");
  sim.apply(op);
}

void undo_all(mvs::Sim &sim) {
  while (!sim.snapshot().history().done.empty()) sim.undo();
}

std::vector<Phase> play() {
  const auto nothing = [](mvs::Sim &) {};
  return {{"close", [](mvs::Sim &sim) { sim.set_load(MVS_SYSTOLE_PA); }},
          {"beat", nothing, beat},
          {"chord", shorten},
          {"ring", sew_ring},
          {"beat again", nothing, beat},
          {"cut", cut_chord},
          {"undo", undo_all},
          {"load off", [](mvs::Sim &sim) { sim.set_load(0, 0); }},
          {"load on", [](mvs::Sim &sim) { sim.set_load(MVS_SYSTOLE_PA); }},
          {"alone", nothing}};
}

void take_step(mvs::Sim &sim, const Options &options, Row &row) {
  mvs_step_options how = {};
  how.dt = dt;
  how.budget = options.budget;
  const double start = cpu_now();
  sim.step(how);
  const double took = cpu_now() - start;
  const mvs_stats stats = sim.stats();
  (stats.skipped & MVS_SKIPPED_STEP ? row.resting : row.active).push_back(took);
  row.lowered_linear += (stats.lowered & MVS_LOWERED_LINEAR) != 0;
  row.lowered_step += (stats.lowered & MVS_LOWERED_STEP) != 0;
  row.broad += stats.broad_phases;
  row.orderings += stats.orderings;
}

Row run_phase(mvs::Sim &sim, const Options &options, const std::string &scene, const Phase &phase,
              int steps) {
  Row row;
  row.scene = scene;
  row.phase = phase.name;
  phase.begin(sim);
  for (int k = 0; k < steps; ++k) {
    if (phase.during) phase.during(sim, k);
    take_step(sim, options, row);
    if (k % std::max(1, steps / samples) == 0) {
      row.crossings = std::max(row.crossings, sim.snapshot().measure().intersections);
    }
  }
  return row;
}

double explicit_step(const std::string &scene) {
  mvs::Sim sim;
  mvs_parametric_desc valve = {};
  valve.vertices = scene_vertices.at(scene);
  sim.generate(valve);
  sim.set_load(MVS_SYSTOLE_PA);
  sim.settle();
  std::vector<double> took;
  for (int k = 0; k < explicit_steps; ++k) {
    mvs_step_options how = {};
    how.solver = MVS_SOLVER_EXPLICIT;
    const double start = cpu_now();
    sim.step(how);
    took.push_back(cpu_now() - start);
  }
  return percentile(took, 0.5);
}

void print_head() {
  std::printf("%-5s %-11s %7s %9s %9s %9s %9s %8s %14s %6s %6s %5s\n", "scene", "phase", "steps",
              "p50 ms", "p99 ms", "p99.9 ms", "max ms", "asleep", "lowered", "broad", "order",
              "cross");
}

void print(const Row &row) {
  const std::vector<double> all = all_of(row);
  std::printf("%-5s %-11s %7zu %9.3f %9.3f %9.3f %9.3f %7.1f%% %6zu %7zu %6zu %6zu %5u\n",
              row.scene.c_str(), row.phase.c_str(), row.steps(), 1e3 * percentile(all, 0.5),
              1e3 * percentile(all, 0.99), 1e3 * percentile(all, 0.999), 1e3 * percentile(all, 1),
              100 * static_cast<double>(row.resting.size()) / static_cast<double>(row.steps()),
              row.lowered_linear, row.lowered_step, row.broad, row.orderings, row.crossings);
  std::fflush(stdout);
}

void write(std::ofstream &csv, const Row &row) {
  const std::vector<double> all = all_of(row);
  csv << row.scene << ',' << row.phase << ',' << row.steps();
  for (const double share : {0.5, 0.99, 0.999, 1.0}) csv << ',' << 1e3 * percentile(all, share);
  csv << ',' << 1e3 * percentile(row.active, 0.5) << ',' << 1e3 * percentile(row.active, 0.99)
      << ',' << 1e3 * percentile(row.resting, 0.5) << ',' << row.resting.size() << ','
      << row.lowered_linear << ',' << row.lowered_step << ',' << row.broad << ',' << row.orderings
      << ',' << row.crossings << '\n';
}

void run(const Options &options) {
  std::ofstream csv;
  if (!options.csv.empty()) csv.open(options.csv);
  csv << "scene,phase,steps,p50_ms,p99_ms,p99.9_ms,max_ms,active_p50_ms,active_p99_ms,"
         "resting_p50_ms,asleep,lowered_linear,lowered_step,broad_phases,orderings,crossings\n";
  print_head();
  for (const std::string &scene : options.scenes) {
    mvs::Sim sim;
    mvs_parametric_desc valve = {};
    valve.vertices = scene_vertices.at(scene);
    sim.generate(valve);
    const std::vector<Phase> phases = play();
    const int steps = std::max(
        2, static_cast<int>(options.seconds / dt / static_cast<double>(phases.size()) + 0.5));
    Row whole;
    whole.scene = scene;
    whole.phase = "all";
    for (const Phase &phase : phases) {
      const Row row = run_phase(sim, options, scene, phase, steps);
      print(row);
      write(csv, row);
      whole.add(row);
    }
    print(whole);
    write(csv, whole);
    const double active = percentile(whole.active, 0.5), resting = percentile(whole.resting, 0.5);
    std::printf(
        "%s: active steps p50 %.3f ms, p99 %.3f ms; resting / active %.2f %%; explicit step "
        "%.3f ms, 125 of them %.1f times an active one\n",
        scene.c_str(), 1e3 * active, 1e3 * percentile(whole.active, 0.99), 100 * resting / active,
        1e3 * explicit_step(scene), 125 * explicit_step(scene) / active);
  }
  if (csv.is_open() && !csv.flush()) throw std::runtime_error("could not write " + options.csv);
}

}  // namespace

int main(int argc, char **argv) {
  try {
    Options options;
    CLI::App app("What a live step costs, over a minute of scripted play.");
    app.add_option("--scenes", options.scenes, "S 425, M 1700 vertices")
        ->capture_default_str()
        ->check(CLI::IsMember({"S", "M"}));
    app.add_option("--seconds", options.seconds, "of simulated time, for all phases together")
        ->check(CLI::PositiveNumber);
    app.add_option("--budget", options.budget, "of a step; 0: the default");
    app.add_option("--csv", options.csv, "write the table there too");
    CLI11_PARSE(app, argc, argv);
    run(options);
    return 0;
  } catch (const std::exception &error) {
    std::fprintf(stderr, "bench_step: %s\n", error.what());
    return 1;
  }
}
