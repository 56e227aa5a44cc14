// Cost of a live step: a minute of scripted play at 1 kHz, every step timed.
//
//   bench_step                       scenes S and M, 60 s of simulated time each
//   bench_step --seconds 2 --scenes S
//   bench_step --seconds 1 --scenes 20k --closed
//                                    20,000 vertices, 77 steps a phase of the play, which would not
//                                    close the valve: a settle does first
//   bench_step --csv FILE            also as a table, one row a scene and phase of the play
//   bench_step --tool convex         the ball of the play as a convex tool of 200 vertices, beside
//                                    the play with the ball: ratios of the steps while it pushes
//   bench_step --shape healthy       on the default valve, whose leaflets are membranes
//
// The play takes some ten seconds and is repeated: a valve closes under systole and beats; a hand
// grasps the edge of A2, pulls it 10 mm into the atrium, and releases it; a ball pushes P2 down and
// is removed; a chord is shortened and a ring sewn in; the valve beats again, a chord is cut, all
// operations are undone, the valve rests, and the load is removed. Times are CPU times of the
// thread (CLOCK_THREAD_CPUTIME_ID), which depend less on other work on the machine; with --workers
// those of the wall clock, for a quiet machine. Columns:
// "asleep" is the share of steps that only advanced the time; "lowered" counts steps that reduced
// the accuracy of the linear solution or the length of the step for their budget; "cross" is the
// largest number of crossing triangle pairs, by the exact test, at samples; "made" counts awake
// steps with constant load, boundary and tools that created energy, by the criterion of
// tests/stability. "resting / active" compares the medians of both kinds of steps. "explicit" is
// the median step of the founding paper's method, 8 us long, on the closed valve: 125 of them make
// one of ours.
#include <mvs/experimental.hpp>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <functional>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/bench/clock.h"
#include "tests/bench/closing.h"
#include "tests/bench/live/first_steps.h"
#include "tests/bench/live/step_play.h"
#include "tests/bench/live/step_row.h"
#include "tests/bench/live/step_watch.h"

namespace {

using bench::percentile;
using bench::Phase;
using bench::StepRow;
using bench::StepWatch;

const std::map<std::string, uint32_t> scene_vertices = {
    {"S", 425}, {"M", 1700}, {"L", 6800}, {"20k", 20000}};
constexpr double dt = 1e-3;
constexpr double play_s = 10;
constexpr int explicit_steps = 200;
constexpr int samples = 20;  // of crossings, in a phase
// m a step: at a stiffness of 1e3 N/m it changes the force on a node by 1e-5 N, the residual at
// rest
constexpr double at_rest = 1e-8;

struct Options {
  std::vector<std::string> scenes = {"S", "M"};
  double seconds = 60;
  uint32_t budget = 0, workers = 1;
  bool closed = false;
  std::string csv, tool = "ball", shape = "founding";

  mvs_parametric_desc valve_of(const std::string &scene) const;
  double now() const {
    return bench::read_clock(workers > 1 ? CLOCK_MONOTONIC : CLOCK_THREAD_CPUTIME_ID);
  }
};

mvs_parametric_desc Options::valve_of(const std::string &scene) const {
  mvs_parametric_desc valve = {};
  valve.shape = shape == "founding" ? MVS_SHAPE_FOUNDING : MVS_SHAPE_HEALTHY;
  valve.vertices = scene_vertices.at(scene);
  return valve;
}

// One step and its cost. Reading a valve makes a snapshot, so only awake steps are checked: steps
// at rest are timed without a snapshot.
void take_step(mvs::Simulator &sim, const Options &options, bool hand_moves, StepWatch &watch,
               StepRow &row) {
  mvs_step_options how = {};
  how.dt = dt;
  how.budget = options.budget;
  const double start = options.now();
  sim.step(how);
  const double took = options.now() - start;
  const mvs_stats stats = sim.stats();
  const mvs_profile profile = mvs::profile_of(sim);
  const bool asleep = (profile.skipped & MVS_SKIPPED_STEP) != 0;
  (asleep ? row.resting : row.active).push_back(took);
  if (hand_moves) row.hand.push_back(took);
  row.lowered_linear += (stats.lowered & MVS_LOWERED_LINEAR) != 0;
  row.lowered_step += (stats.lowered & MVS_LOWERED_STEP) != 0;
  row.broad += profile.broad_phases;
  row.orderings += profile.orderings;
  row.iterations += profile.linear_iterations;
  row.served += !asleep && (profile.skipped & MVS_SKIPPED_FACTOR) != 0;
  if (asleep) return;
  row.passes += profile.passes;
  row.factors += profile.factorisations;
  for (size_t p = 0; p < row.phase_s.size(); ++p) row.phase_s[p] += profile.phase_s[p];
  row.made += watch.makes_energy(sim, stats);
  const double quiet = StepWatch::quiet(sim, dt, at_rest);
  row.quiet += quiet;
  row.quiet_by_hand += hand_moves ? quiet : 0;
}

StepRow run_phase(mvs::Simulator &sim, const Options &options, const std::string &scene,
                  const Phase &phase, int steps) {
  StepRow row;
  row.scene = scene;
  row.phase = phase.name;
  StepWatch watch;
  phase.begin(sim);
  for (int k = 0; k < steps; ++k) {
    Phase::Done done = Phase::Done::nothing;
    if (phase.during) done = phase.during(sim, k, static_cast<double>(k + 1) / steps);
    if (done != Phase::Done::nothing) watch.changed();
    take_step(sim, options, done == Phase::Done::hand_moved, watch, row);
    if (k % std::max(1, steps / samples) == 0) {
      row.crossings = std::max(row.crossings, StepWatch::crossings(sim));
    }
  }
  return row;
}

// A row a phase, over all its repetitions; told to `done` once it is complete.
std::vector<StepRow> run_scene(const Options &options, const std::string &scene,
                               bench::Pusher pusher,
                               const std::function<void(const StepRow &)> &done) {
  mvs_sim_desc desc = {};
  desc.workers = options.workers;
  mvs::Simulator sim(desc);
  sim.generate(options.valve_of(scene));
  if (options.closed) {
    sim.set_load(MVS_SYSTOLE_PA);
    sim.settle();
  }
  const std::vector<Phase> phases = bench::play(pusher);
  const double times = std::max(1.0, std::round(options.seconds / play_s));
  const double share = options.seconds / (times * static_cast<double>(phases.size()));
  const int steps = std::max(2, static_cast<int>(std::lround(share / dt)));
  std::vector<StepRow> rows(phases.size());
  for (int time = 0; time < static_cast<int>(times); ++time) {
    for (size_t p = 0; p < phases.size(); ++p) {
      const StepRow row = run_phase(sim, options, scene, phases[p], steps);
      rows[p].scene = scene;
      rows[p].phase = row.phase;
      rows[p].add(row);
      if (time + 1 == static_cast<int>(times)) done(rows[p]);
    }
  }
  return rows;
}

double explicit_step(const Options &options, const std::string &scene) {
  mvs::Simulator sim;
  sim.generate(options.valve_of(scene));
  sim.set_load(MVS_SYSTOLE_PA);
  sim.settle();
  std::vector<double> took;
  for (int k = 0; k < explicit_steps; ++k) {
    mvs_step_options how = {};
    how.solver = MVS_SOLVER_EXPLICIT;
    const double start = options.now();
    sim.step(how);
    took.push_back(options.now() - start);
  }
  return percentile(took, 0.5);
}

void tell(const Options &options, const std::string &scene, const StepRow &whole) {
  print(whole, "active steps", whole.active);
  print(whole, "steps with a hand moving", whole.hand);
  const auto steps = static_cast<double>(std::max<size_t>(1, whole.active.size()));
  std::printf("%s: %.1f linear iterations an active step; %.0f %% of them worked on no factor\n",
              scene.c_str(), static_cast<double>(whole.iterations) / steps,
              100 * static_cast<double>(whole.served) / steps);
  std::printf("%s: an active step has %.2f passes, %.2f broad phases, %.3f factors", scene.c_str(),
              static_cast<double>(whole.passes) / steps, static_cast<double>(whole.broad) / steps,
              static_cast<double>(whole.factors) / steps);
  for (size_t p = 0; p < whole.phase_s.size(); ++p) {
    std::printf("%s %s %.2f", p == 0 ? "; ms of wall time:" : ",", bench::phase_names[p].c_str(),
                1e3 * whole.phase_s[p] / steps);
  }
  std::printf("\n");
  std::printf(
      "%s: %.0f %% of the nodes go less than 1e-8 m in an active step, %.0f %% while a hand "
      "moves: what parts asleep could save\n",
      scene.c_str(), 100 * whole.quiet / steps,
      100 * whole.quiet_by_hand / std::max(1.0, static_cast<double>(whole.hand.size())));
  const double active = percentile(whole.active, 0.5), resting = percentile(whole.resting, 0.5);
  const double founding = explicit_step(options, scene);
  std::printf(
      "%s: resting / active %.2f %%; explicit step %.3f ms, 125 of them %.1f times an active "
      "one\n",
      scene.c_str(), 100 * resting / active, 1e3 * founding, 125 * founding / active);
}

void compare(const std::string &scene, const StepRow &convex, const StepRow &ball) {
  std::printf("%s: pushing with 200 vertices takes p50 %.2f, p99 %.2f, max %.2f times the ball's\n",
              scene.c_str(), percentile(convex.active, 0.5) / percentile(ball.active, 0.5),
              percentile(convex.active, 0.99) / percentile(ball.active, 0.99),
              percentile(convex.active, 1) / percentile(ball.active, 1));
  print(ball);
}

void run(const Options &options) {
  std::ofstream csv;
  if (!options.csv.empty()) csv.open(options.csv);
  bench::write_head(csv);
  for (const std::string &scene : options.scenes) {
    bench::print_head();
    StepRow whole;
    whole.scene = scene;
    whole.phase = "all";
    StepRow pushed, pushed_by_ball;
    if (options.tool == "convex") {
      run_scene(options, scene, bench::Pusher::ball, [&](const StepRow &row) {
        if (row.phase == bench::push_phase) pushed_by_ball = row;
      });
    }
    const auto pusher = options.tool == "convex" ? bench::Pusher::convex : bench::Pusher::ball;
    run_scene(options, scene, pusher, [&](const StepRow &row) {
      print(row);
      write(csv, row);
      whole.add(row);
      if (row.phase == bench::push_phase) pushed = row;
    });
    if (options.tool == "convex") compare(scene, pushed, pushed_by_ball);
    print(whole);
    write(csv, whole);
    tell(options, scene, whole);
    bench::tell_first_steps(scene, options.valve_of(scene), [&] { return options.now(); });
  }
  if (csv.is_open() && !csv.flush()) throw std::runtime_error("could not write " + options.csv);
}

}  // namespace

int main(int argc, char **argv) {
  try {
    Options options;
    CLI::App app("What a live step costs, over a minute of scripted play.");
    app.add_option("--scenes", options.scenes, "S 425, M 1700, L 6800, 20k 20000 vertices")
        ->capture_default_str()
        ->check(CLI::IsMember({"S", "M", "L", "20k"}));
    app.add_option("--seconds", options.seconds, "of simulated time, for all phases together")
        ->check(CLI::PositiveNumber);
    app.add_option("--budget", options.budget, "of a step; 0: the default");
    app.add_option("--workers", options.workers,
                   "threads; with more than one, times are wall-clock")
        ->check(CLI::Range(1u, uint32_t{MVS_MAX_WORKERS}));
    app.add_flag("--closed", options.closed,
                 "close the valve by a settle first: a short play of a large valve steps a closed "
                 "one");
    app.add_option("--tool", options.tool, "that pushes P2")
        ->capture_default_str()
        ->check(CLI::IsMember({"ball", "convex"}));
    app.add_option("--shape", options.shape, "springs, or the default valve with its membranes")
        ->capture_default_str()
        ->check(CLI::IsMember({"founding", "healthy"}));
    app.add_option("--csv", options.csv, "write the table there too");
    CLI11_PARSE(app, argc, argv);
    run(options);
    return 0;
  } catch (const std::exception &error) {
    std::fprintf(stderr, "bench_step: %s\n", error.what());
    return 1;
  }
}
