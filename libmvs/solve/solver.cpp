// Dispatch over the solvers: fills in default options and runs the solver that they name.
#include "solve/solver.h"

#include <mvs/sim.h>

#include <cmath>
#include <optional>

#include "base/error.h"
#include "linalg/mixed_precision.h"
#include "solve/dynamic/explicit_euler.h"
#include "solve/dynamic/implicit_euler.h"
#include "solve/dynamic/settling_in_time.h"
#include "solve/newton_with_steps.h"
#include "solve/settings.h"
#include "solve/static/mesh_hierarchy.h"
#include "solve/tools/tool_points.h"

namespace mvs::core {
namespace {

// Fills in the defaults.
StepOptions step_options(const SolveOptions &options) {
  namespace set = settings::defaults;
  const bool is_explicit = options.solver == SolverKind::explicit_euler;
  StepOptions how{options.dt, options.damping, options.budget, true, options.margins};
  if (how.dt == 0) how.dt = set::implicit_dt;  // explicit: with_stable_dt
  if (how.damping == 0 && is_explicit) how.damping = set::explicit_damping;
  if (how.budget == 0) how.budget = set::budget;
  return how;
}

// The default time step of the explicit solver depends on the valve.
SolveOptions with_stable_dt(SolveOptions options, const ExplicitEuler &stepper) {
  if (options.dt == 0) options.dt = stepper.stable_dt();
  return options;
}

// Steps that settle continue until the residual, with all the work that a step may need.
StepOptions settle_options(const SolveOptions &options) {
  StepOptions how = step_options(options);
  how.budget = settings::defaults::settle_budget;
  how.may_sleep = false;
  return how;
}

// The bits of mvs_profile.skipped that follow from the counts of a whole run.
uint32_t skipped_in_run(const Profile &work) {
  uint32_t skipped = 0;
  if (work.broad_phases == 0) skipped |= MVS_SKIPPED_BROAD;
  if (work.orderings == 0) skipped |= MVS_SKIPPED_ORDERING;
  return skipped;
}

// One step, with the statistics of its call.
template <typename Stepper>
void step_alone(Stepper &stepper, State &state, const StepOptions &how, SolveStats &stats) {
  stepper.begin_call();
  stepper.step(state, how, stats);
  stats.skipped |= stepper.skipped();
}

// Throws MVS_E_UNSUPPORTED where the solver cannot push with the tools.
uint32_t points_for(const std::vector<Tool> &tools, const SolveOptions &options) {
  const uint32_t points = tool_points(tools);
  MVS_MUST(points == 0 || options.solver != SolverKind::explicit_euler, MVS_E_UNSUPPORTED, "tool",
           "the explicit solver does not prevent penetration and cannot push with a tool: remove "
           "it, or use another solver");
  return points;
}

// The loop of a solver over all nodes, those of the points of tools included.
class ValveSettling final : public Settling {
 public:
  ValveSettling(std::unique_ptr<Settling> loop, double tolerance)
      : loop_(std::move(loop)), tolerance_(tolerance) {}

  bool advance() override { return loop_->advance(); }
  bool begins_far_from_rest() const override { return loop_->begins_far_from_rest(); }
  double largest_first_force() const override { return loop_->largest_first_force(); }

  SolveStats finish(State &state) override {
    State nodes = ToolPoints::extended(state);
    SolveStats stats = loop_->finish(nodes);
    nodes.drop_cache();
    nodes.rest_tolerance = stats.converged ? tolerance_ : 0;
    stats.skipped |= skipped_in_run(stats.work);
    if (state.tools.empty()) stats.skipped |= MVS_SKIPPED_TOOLS;
    ToolPoints::take_back(std::move(nodes), state);
    return stats;
  }

 private:
  std::unique_ptr<Settling> loop_;
  double tolerance_;  // N, the residual at rest
};

std::unique_ptr<DirectSolver> make_newton_factor(Backend backend) {
  return backend == Backend::fastest ? make_mixed_precision_cholesky()
                                     : make_direct_solver(backend);
}

}  // namespace

double SolveOptions::tolerance() const {
  return residual > 0 ? residual : settings::defaults::residual;
}

uint32_t SolveOptions::most_iterations() const {
  if (max_iterations > 0) return max_iterations;
  switch (solver) {
    case SolverKind::explicit_euler:
      return settings::defaults::explicit_steps;
    case SolverKind::implicit_euler:
      return settings::defaults::implicit_steps;
    default:
      return settings::defaults::newton_iterations;
  }
}

// The solvers of the last model, so that a sequence of steps keeps its matrices.
struct Solver::Work {
  Work(Backend backend_in, Workers *workers_in)
      : backend(backend_in), workers(workers_in), factor(make_newton_factor(backend)) {
    factor->use_workers(workers);
  }

  ImplicitEuler &implicit_for(const Model &model) {
    if (implicit_model != model.serial) implicit.reset();
    implicit_model = model.serial;
    if (!implicit) implicit.emplace(model, backend, workers);
    return *implicit;
  }
  // A solver that throws half-way through its work is not used again.
  template <typename Use>
  void use_implicit(const Model &model, Use &&use) {
    try {
      use(implicit_for(model));
    } catch (...) {
      implicit.reset();
      throw;
    }
  }
  ExplicitEuler &explicit_for(const Model &model) {
    if (explicit_model != model.serial) explicit_.reset();
    explicit_model = model.serial;
    if (!explicit_) explicit_.emplace(model);
    return *explicit_;
  }

  const Backend backend;
  Workers *const workers;
  CoarseLevels coarse_levels;
  ToolPoints tool_points;
  std::unique_ptr<DirectSolver> factor;  // of settling
  std::optional<ImplicitEuler> implicit;
  std::optional<ExplicitEuler> explicit_;
  StepOptions how{};                                // of the last implicit step
  uint64_t implicit_model = 0, explicit_model = 0;  // serial numbers
};

Solver::Solver(Backend backend, Workers *workers)
    : work_(std::make_unique<Work>(backend, workers)) {}
Solver::~Solver() = default;
Solver::Solver(Solver &&) noexcept = default;
Solver &Solver::operator=(Solver &&) noexcept = default;

CoarseLevels &Solver::coarse_levels() {
  return work_->coarse_levels;
}

std::unique_ptr<Settling> Solver::loop_over_nodes(const Model &model, State state,
                                                  const SolveOptions &options,
                                                  const Progress &progress) {
  if (options.solver == SolverKind::implicit_euler) {
    auto stepper = std::make_unique<ImplicitEuler>(model, work_->backend, work_->workers);
    return std::make_unique<SettlingInTime<ImplicitEuler>>(
        model, std::move(stepper), std::move(state), settle_options(options),
        options.most_iterations(), options.tolerance(), progress);
  }
  if (options.solver == SolverKind::explicit_euler) {
    auto stepper = std::make_unique<ExplicitEuler>(model);
    const StepOptions how = settle_options(with_stable_dt(options, *stepper));
    return std::make_unique<SettlingInTime<ExplicitEuler>>(
        model, std::move(stepper), std::move(state), how, options.most_iterations(),
        options.tolerance(), progress);
  }
  auto make_steps = [this, &model, options](State start, uint32_t most, const Progress &part) {
    SolveOptions in_time = options;
    in_time.solver = SolverKind::implicit_euler;
    in_time.max_iterations = most;
    return loop_over_nodes(model, std::move(start), in_time, part);
  };
  return std::make_unique<NewtonWithSteps>(model, *work_->factor, state, options, progress,
                                           std::move(make_steps));
}

std::unique_ptr<Settling> Solver::begin_settle(const Model &valve, const State &valve_state,
                                               const SolveOptions &options,
                                               const Progress &progress) {
  const uint32_t points = points_for(valve_state.tools, options);
  const Model &model = work_->tool_points.extend(valve, points);
  State state = ToolPoints::extended(valve_state);
  state.drop_cache();
  auto loop = loop_over_nodes(model, std::move(state), options, progress);
  return std::make_unique<ValveSettling>(std::move(loop), options.tolerance());
}

SolveStats Solver::settle(const Model &model, State &state, const SolveOptions &options,
                          const Progress &progress) {
  return run(*begin_settle(model, state, options, progress), state);
}

SolveStats Solver::step(const Model &valve, State &valve_state, const SolveOptions &options) {
  const uint32_t points = points_for(valve_state.tools, options);
  if (points == 0) {
    SolveStats stats = step_nodes(valve, valve_state, options);
    if (valve_state.tools.empty()) stats.skipped |= MVS_SKIPPED_TOOLS;
    return stats;
  }
  State state = ToolPoints::extended(valve_state);
  const SolveStats stats = step_nodes(work_->tool_points.extend(valve, points), state, options);
  ToolPoints::take_back(std::move(state), valve_state);
  return stats;
}

SolveStats Solver::step_nodes(const Model &model, State &state, const SolveOptions &options) {
  const double start = seconds_now();
  StepOptions how = step_options(options);
  SolveStats stats;
  if (options.solver == SolverKind::explicit_euler) {
    ExplicitEuler &stepper = work_->explicit_for(model);
    how = step_options(with_stable_dt(options, stepper));
    state.drop_cache();
    step_alone(stepper, state, how, stats);
  } else {
    work_->how = how;
    work_->use_implicit(model,
                        [&](ImplicitEuler &stepper) { step_alone(stepper, state, how, stats); });
  }
  const bool stands = (stats.skipped & MVS_SKIPPED_STEP) != 0;
  state.rest_tolerance = stands ? rest_tolerance_of(state.load) : 0;
  stats.converged = stands;
  state.time += how.dt;
  ++state.steps;
  stats.iterations = 1;
  stats.skipped |= skipped_in_run(stats.work);
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

void Solver::prepare_step(const Model &valve, const State &valve_state,
                          const SolveOptions &options) {
  const Model &model = work_->tool_points.extend(valve, points_for(valve_state.tools, options));
  if (options.solver == SolverKind::explicit_euler) {
    work_->explicit_for(model);
    return;
  }
  State state = ToolPoints::extended(valve_state);
  work_->how = step_options(options);
  StepOptions awake = work_->how;
  awake.may_sleep = false;  // a valve at rest may be about to move
  work_->use_implicit(model, [&](ImplicitEuler &stepper) { stepper.make_ready(state, awake); });
}

}  // namespace mvs::core
