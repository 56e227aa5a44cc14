// One face for the solvers: options checked, defaults filled in, the right one run.
#include "solve/solver.h"

#include <mvs/sim.h>

#include <cmath>
#include <optional>

#include "base/error.h"
#include "energy/forces.h"
#include "linalg/mixed_precision.h"
#include "solve/dynamic/explicit_euler.h"
#include "solve/dynamic/implicit_euler.h"
#include "solve/nodes.h"
#include "solve/static/newton.h"
#include "solve/tools/tool_points.h"

namespace mvs::core {
namespace {

constexpr uint32_t default_budget = 64;
constexpr uint32_t largest_budget = 10000;

StepOptions defaults(const SolveOptions &options) {
  const bool is_explicit = options.solver == MVS_SOLVER_EXPLICIT;
  StepOptions how{options.dt, options.damping, options.budget, true};
  if (how.dt == 0) how.dt = is_explicit ? 8e-6 : 1e-3;
  if (how.damping == 0 && is_explicit) how.damping = 500;
  if (how.budget == 0) how.budget = default_budget;
  return how;
}

// Settling goes on until the residual asked for, with all the work that a step may need.
StepOptions settling(const SolveOptions &options) {
  StepOptions how = defaults(options);
  how.budget = largest_budget;
  how.may_sleep = false;
  return how;
}

uint32_t most_steps(const SolveOptions &options) {
  if (options.max_iterations > 0) return options.max_iterations;
  return options.solver == MVS_SOLVER_EXPLICIT ? 2000000 : 20000;
}

// What of mvs_stats.skipped the counts of a whole run tell.
uint32_t never_done(const Profile &work) {
  uint32_t skipped = 0;
  if (work.broad_phases == 0) skipped |= MVS_SKIPPED_BROAD;
  if (work.orderings == 0) skipped |= MVS_SKIPPED_ORDERING;
  return skipped;
}

// A boundary that steps in time have brought within rounding of its target is there.
constexpr double arrival = 1e-9;  // m

// Steps until the out-of-balance force is below the tolerance and stays there for a while, so that
// a valve passing through balance in motion does not count as at rest.
template <typename Step>
SolveStats settle_in_time(const Model &model, State &state, const SolveOptions &options,
                          const Progress &progress, Step &&step) {
  constexpr int calm_needed = 10;
  const double start = seconds_now();
  const double tolerance = options.residual > 0 ? options.residual : 1e-5;
  const StepOptions how = settling(options);
  const uint32_t most = most_steps(options);
  SolveStats stats;
  int calm = 0;
  while (stats.iterations < most && calm < calm_needed) {
    ++stats.iterations;
    step(how, stats);
    state.time += how.dt;
    ++state.steps;
    const bool at_rest = stats.residual <= tolerance &&
                         boundary_is_there(model, state.x, state.load.boundary_fraction, arrival);
    calm = at_rest ? calm + 1 : 0;
    const bool tell = progress && stats.iterations % 64 == 0;
    MVS_MUST(!tell || progress(static_cast<double>(stats.iterations) / most, stats.residual),
             MVS_E_CANCELLED, "settle",
             "settling was cancelled by the progress callback; the valve is as before");
  }
  stats.converged = calm == calm_needed;
  state.v.assign(state.v.size(), Vec3::Zero());
  stats.kinetic = 0;
  stats.wall_s = seconds_now() - start;
  return stats;
}

// One step of a stepper that has made others before.
template <typename Stepper>
void step_alone(Stepper &stepper, State &state, const StepOptions &how, SolveStats &stats) {
  stepper.begin_call();
  stepper.step(state, how, stats);
  stats.skipped |= stepper.skipped();
}

std::unique_ptr<DirectSolver> make_newton_factor(uint32_t backend) {
  return backend == MVS_BACKEND_DEFAULT ? make_mixed_precision_cholesky()
                                        : make_direct_solver(backend);
}

}  // namespace

// The workers of the last model, so that a sequence of steps keeps its matrices.
struct Solver::Work {
  explicit Work(uint32_t backend_in) : backend(backend_in), factor(make_newton_factor(backend)) {}

  ImplicitEuler &implicit_for(const Model &model) {
    if (implicit_model != model.serial) implicit.reset();
    implicit_model = model.serial;
    if (!implicit) implicit.emplace(model, backend);
    return *implicit;
  }
  ExplicitEuler &explicit_for(const Model &model) {
    if (explicit_model != model.serial) explicit_.reset();
    explicit_model = model.serial;
    if (!explicit_) explicit_.emplace(model);
    return *explicit_;
  }

  const uint32_t backend;
  ToolPoints tool_points;
  std::unique_ptr<DirectSolver> factor;  // of settling
  std::optional<ImplicitEuler> implicit;
  std::optional<ExplicitEuler> explicit_;
  StepOptions how{};                                // of the last implicit step
  uint64_t implicit_model = 0, explicit_model = 0;  // serial numbers
};

Solver::Solver(uint32_t backend) : work_(std::make_unique<Work>(backend)) {}
Solver::~Solver() = default;
Solver::Solver(Solver &&) noexcept = default;
Solver &Solver::operator=(Solver &&) noexcept = default;

// Runs solve(model, state) with nodes for the points of the tools, if they have any.
template <typename Solve>
SolveStats Solver::with_points(const Model &model, State &state, const SolveOptions &options,
                               Solve solve) {
  const uint32_t points = tool_points(state.tools);
  if (points == 0) {
    SolveStats stats = solve(model, state);
    if (state.tools.empty()) stats.skipped |= MVS_SKIPPED_TOOLS;
    return stats;
  }
  MVS_MUST(options.solver != MVS_SOLVER_EXPLICIT, MVS_E_UNSUPPORTED, "tool",
           "the explicit solver guards against no crossing and cannot push with a ball or rod: "
           "remove it, or take another solver");
  State extended = ToolPoints::extended(state);
  const SolveStats stats = solve(work_->tool_points.extend(model, points), extended);
  ToolPoints::take_back(std::move(extended), state);
  return stats;
}

SolveStats Solver::settle(const Model &model, State &state, const SolveOptions &options,
                          const Progress &progress) {
  return with_points(model, state, options, [&](const Model &m, State &s) {
    return settle_nodes(m, s, options, progress);
  });
}

SolveStats Solver::step(const Model &model, State &state, const SolveOptions &options) {
  return with_points(model, state, options,
                     [&](const Model &m, State &s) { return step_nodes(m, s, options); });
}

SolveStats Solver::settle_nodes(const Model &model, State &state, const SolveOptions &options,
                                const Progress &progress) {
  SolveStats stats;
  state.drop_cache();
  if (options.solver == MVS_SOLVER_IMPLICIT) {
    ImplicitEuler stepper(model, work_->backend);
    const auto step = [&](const StepOptions &how, SolveStats &s) { stepper.step(state, how, s); };
    stats = settle_in_time(model, state, options, progress, step);
    stats.skipped = stepper.skipped();
  } else if (options.solver == MVS_SOLVER_EXPLICIT) {
    ExplicitEuler stepper(model);
    const auto step = [&](const StepOptions &how, SolveStats &s) { stepper.step(state, how, s); };
    stats = settle_in_time(model, state, options, progress, step);
    stats.skipped = stepper.skipped();
  } else {
    stats = Newton(model, *work_->factor).settle(state, options, progress);
  }
  state.drop_cache();
  stats.skipped |= never_done(stats.work);
  return stats;
}

SolveStats Solver::step_nodes(const Model &model, State &state, const SolveOptions &options) {
  const double start = seconds_now();
  const StepOptions how = defaults(options);
  SolveStats stats;
  if (options.solver == MVS_SOLVER_EXPLICIT) {
    state.drop_cache();
    step_alone(work_->explicit_for(model), state, how, stats);
  } else {
    work_->how = how;
    try {
      step_alone(work_->implicit_for(model), state, how, stats);
    } catch (...) {
      work_->implicit.reset();  // half-way: nothing of it is to be kept
      throw;
    }
  }
  state.time += how.dt;
  ++state.steps;
  stats.iterations = 1;
  stats.skipped |= never_done(stats.work);
  stats.wall_s = seconds_now() - start;
  return stats;
}

void Solver::make_ready(const Model &valve, const State &valve_state) noexcept {
  if (!work_->implicit) return;
  try {
    const Model &model = work_->tool_points.extend(valve, tool_points(valve_state.tools));
    if (work_->implicit_model == model.serial) return;
    State state = ToolPoints::extended(valve_state);
    work_->implicit_for(model).make_ready(state, work_->how);
  } catch (...) {
    work_->implicit.reset();
  }
}

Forces evaluate_forces(const Model &valve, const State &valve_state) {
  ToolPoints points;
  const Model &model = points.extend(valve, tool_points(valve_state.tools));
  const State state = ToolPoints::extended(valve_state);
  TotalEnergy total_energy(model);
  Profile profile;
  total_energy.keep_near(false);
  total_energy.set_pressure(state.load.pressure);
  total_energy.set_tools(state.tools);
  total_energy.prepare(state.x, state.x, 0, profile);
  Forces forces;
  forces.energy = total_energy.gradient(state.x, forces.total, profile);
  forces.contact.assign(state.x.size(), Vec3::Zero());
  total_energy.contact().gradient(forces.contact);
  for (Vec3 &f : forces.total) f = -f;
  for (Vec3 &f : forces.contact) f = -f;
  forces.total.resize(valve_state.x.size());
  forces.contact.resize(valve_state.x.size());
  return forces;
}

}  // namespace mvs::core
