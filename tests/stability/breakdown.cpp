// Where symplectic Euler, the founding paper's method, breaks: time step against the size of an
// operation, and the library's own implicit step beside it on the same grid.
//
//   stability_breakdown --csv FILE    the whole grid, seven minutes of CPU
//   stability_breakdown --quick       a coarse one, half a minute
//
// Every run starts from the closed valve with 425 vertices, operates on it, and steps until the
// boundary has arrived (it travels at 0.1 m/s) and 10 ms more. It breaks when numbers leave their
// range, when energy appears while annulus and heads stand still (more than 1 mJ, a tenth of what
// the closed valve stores, and a twentieth of what the operation put in, above the least so far;
// the work of pressure at the free edge apart), or when triangles cross that did not.
// `breakdown.py` draws the table.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "tests/stability/crossings.h"
#include "tests/stability/edge_work.h"
#include "tests/stability/valves.h"

using namespace stability;

namespace {

constexpr double energy_bound = 1e-3;  // J
constexpr double share_bound = 0.05;   // of the energy that the operation added
constexpr double after = 10e-3;        // s, beyond the arrival of the boundary
constexpr double speed = 0.1;          // m/s, of the boundary
constexpr int looks = 100;             // number of checks for crossings in a run

struct Options {
  bool quick = false;
  std::string csv, solver, operation;
};

struct Run {
  const char *operation, *solver;
  double size, dt;
  bool finite = true;
  double grown = 0;  // J
  bool has_grown = false;
  size_t crossed = 0;  // pairs, at most
  double lasted = 0;   // s
  double cpu_s = 0;
};

void operate(mvs::Simulator &sim, const Run &run) {
  if (run.size == 1) return;
  if (std::string(run.operation) == "annulus") {
    mvs_op_annulus_scale op = {};
    op.op = {sizeof op, MVS_OP_ANNULUS_SCALE};
    op.factor = run.size;
    return mvs::must(mvs_apply_op(sim.get(), &op.op, nullptr));
  }
  mvs_op_chord_length op = {};
  op.op = {sizeof op, MVS_OP_CHORD_LENGTH};
  op.chord = sim.snapshot().find(MVS_PART_CHORD, "A2/7").id;
  op.factor = run.size;
  mvs::must(mvs_apply_op(sim.get(), &op.op, nullptr));
}

// m, the longest distance of a prescribed node to its target.
double way_of_boundary(const mvs::Snapshot &now) {
  const auto kinds = now.view<uint8_t>(MVS_ARRAY_NODE_KIND);
  const auto x = now.view<double>(MVS_ARRAY_NODE_POSITION),
             goal = now.view<double>(MVS_ARRAY_NODE_LOADED);
  double most = 0;
  for (size_t n = 0; n < kinds.rows(); ++n) {
    const double *a = x.row(n), *b = goal.row(n);
    if (kinds.data()[n] != MVS_NODE_KIND_ANNULUS && kinds.data()[n] != MVS_NODE_KIND_HEAD) continue;
    most = std::max(most, std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]));
  }
  return most;
}

std::vector<Pair> crossings_of(const mvs::Snapshot &now) {
  const auto x = now.view<double>(MVS_ARRAY_NODE_POSITION);
  const auto triangles = now.view<uint32_t>(MVS_ARRAY_TRIANGLE_NODES);
  return crossings(x.data(), x.rows(), triangles.data(), triangles.rows());
}

// J, potential and kinetic, from the statistics of a step too short for any motion.
double energy_of(const mvs::Snapshot &valve) {
  mvs::Simulator sim;
  mvs::must(mvs_restore(sim.get(), valve.get()));
  mvs_step_options options = {};
  options.dt = 1e-9;
  sim.step(options);
  return sim.stats().energy + sim.stats().kinetic;
}

// Energy created, step by step.
class Ledger {
 public:
  Ledger(const mvs::Snapshot &closed, bool is_explicit)
      : edge_(closed), is_explicit_(is_explicit), closed_(energy_of(closed)) {}

  void take(const mvs::Snapshot &now, const mvs_stats &stats, bool boundary_stands) {
    // Symplectic Euler reports the potential at the start of a step, and the speed at its end. With
    // the mean of the kinetic energies on either side its energy is right to second order, and does
    // not oscillate by the share omega dt in a sound run.
    const double mean = 0.5 * (kinetic_ + stats.kinetic);
    const double energy = stats.energy + (is_explicit_ ? mean : stats.kinetic);
    const std::vector<double> before = x_;
    const auto x = now.view<double>(MVS_ARRAY_NODE_POSITION);
    x_.assign(x.begin(), x.end());
    const double pressure = now.load().pressure;
    const bool known = !before.empty();
    if (known && !is_explicit_) work_ += pressure * edge_.held(before.data(), x_.data());
    if (boundary_stands) note(energy - work_);
    if (known && is_explicit_) work_ += pressure * edge_.followed(before.data(), x_.data());
    kinetic_ = stats.kinetic;
  }
  bool has_grown() const {
    return grown_ > energy_bound && grown_ > share_bound * (first_ - closed_);
  }
  double grown() const { return grown_; }

 private:
  void note(double energy) {
    if (least_ == INFINITY) first_ = energy;
    least_ = std::min(least_, energy);
    grown_ = std::max(grown_, energy - least_);
  }

  EdgeWork edge_;
  bool is_explicit_;
  double closed_;  // J
  std::vector<double> x_;
  double work_ = 0, kinetic_ = 0, first_ = 0, least_ = INFINITY, grown_ = 0;
};

void play(Run &run) {
  mvs::Simulator sim;
  mvs::must(mvs_restore(sim.get(), closed_valve("S").get()));
  operate(sim, run);
  const std::vector<Pair> before = crossings_of(sim.snapshot());
  const double travel = way_of_boundary(sim.snapshot()) / speed, until = travel + after;
  const auto steps = static_cast<long>(std::ceil(until / run.dt));
  const long every = std::max(1L, steps / looks);
  mvs_step_options options = mvs::sized<mvs_step_options>();
  options.solver = run.solver[0] == 'e' ? MVS_SOLVER_EXPLICIT : MVS_SOLVER_IMPLICIT;
  options.dt = run.dt;
  Ledger ledger(closed_valve("S"), options.solver == MVS_SOLVER_EXPLICIT);
  for (long k = 1; k <= steps; ++k) {
    if (mvs_step(sim.get(), &options) != MVS_OK) {
      run.finite = false;
      return;
    }
    run.lasted = static_cast<double>(k) * run.dt;
    const mvs::Snapshot now = sim.snapshot();
    ledger.take(now, sim.stats(), run.lasted > travel + 2 * run.dt);
    run.grown = ledger.grown();
    run.has_grown = ledger.has_grown();
    if (k % every && k < steps) continue;
    const std::vector<Pair> found = crossings_of(now);
    std::vector<Pair> fresh;
    std::set_difference(found.begin(), found.end(), before.begin(), before.end(),
                        std::back_inserter(fresh));
    run.crossed = std::max(run.crossed, fresh.size());
  }
}

const char *verdict_of(const Run &run) {
  if (!run.finite) return "not finite";
  if (run.has_grown) return "energy";
  return run.crossed > 0 ? "crossed" : "sound";
}

void write(std::ostream &out, const Run &run) {
  out << run.operation << ',' << run.size << ',' << run.solver << ',' << run.dt * 1e6 << ','
      << verdict_of(run) << ',' << run.lasted * 1e3 << ',' << run.grown << ',' << run.crossed << ','
      << run.cpu_s << std::endl;
}

Run played(Run run) {
  const std::clock_t start = std::clock();
  play(run);
  run.cpu_s = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  std::printf("%-8s %5.2f  %-9s %9.1f us  %-10s %8.2f ms  %9.1e J  %4zu  %7.2f s\n", run.operation,
              run.size, run.solver, run.dt * 1e6, verdict_of(run), run.lasted * 1e3, run.grown,
              run.crossed, run.cpu_s);
  std::fflush(stdout);
  return run;
}

// Small explicit steps take longest, and large ones mostly end at once; the grid of implicit steps
// begins where a run takes half a minute.
void play_grid(const Options &options, const char *operation, const std::vector<double> &sizes,
               std::ostream &out) {
  if (!options.operation.empty() && options.operation != operation) return;
  std::vector<double> steps = {4e-6,   8e-6,   16e-6, 32e-6, 64e-6, 128e-6,
                               256e-6, 512e-6, 1e-3,  2e-3,  5e-3,  20e-3};
  if (options.quick) steps = {8e-6, 32e-6, 128e-6, 2e-3, 20e-3};
  // the annulus moves for up to 0.1 s
  const double least = std::string(operation) == "annulus" ? 32e-6 : 8e-6;
  const double smallest = options.quick ? 128e-6 : least;
  for (const char *solver : {"explicit", "implicit"}) {
    if (!options.solver.empty() && options.solver != solver) continue;
    for (const double dt : steps) {
      if (solver[0] == 'i' && dt < smallest) continue;
      for (const double size : sizes) write(out, played({operation, solver, size, dt}));
    }
  }
}

int run(int argc, char **argv) {
  Options options;
  CLI::App app("Maps where steps in time break.", "stability_breakdown");
  app.add_flag("--quick", options.quick, "a coarse grid");
  app.add_option("--solver", options.solver, "only explicit, or only implicit");
  app.add_option("--operation", options.operation, "only annulus, or only chord");
  app.add_option("--csv", options.csv, "file to write the table to");
  CLI11_PARSE(app, argc, argv);
  std::ofstream file;
  if (!options.csv.empty()) file.open(options.csv);
  file << "operation,size,solver,dt_us,verdict,lasted_ms,grown_J,crossed,cpu_s\n";
  const bool quick = options.quick;
  play_grid(options, "annulus",
            quick ? std::vector<double>{1, 0.6, 0.25}
                  : std::vector<double>{1, 0.85, 0.7, 0.55, 0.4, 0.25},
            file);
  play_grid(
      options, "chord",
      quick ? std::vector<double>{1, 0.5, 0.1} : std::vector<double>{1, 0.9, 0.7, 0.5, 0.3, 0.1},
      file);
  return options.csv.empty() || file ? 0 : 1;
}

}  // namespace

int main(int argc, char **argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception &error) {
    std::fprintf(stderr, "stability_breakdown: %s\n", error.what());
    return 1;
  }
}
