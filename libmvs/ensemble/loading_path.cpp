// Stages of a loading path, and the closure along them.
#include "ensemble/loading_path.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "model/finite.h"
#include "solve/nodes.h"
#include "solve/static/mesh_hierarchy.h"

namespace mvs::core {
namespace {

// Residual between increments, as a share of the force of the pressure on a node of mean area, and
// iterations, as many as a closure takes at most.
constexpr double between_residual = 0.1;
constexpr uint32_t between_iterations = 100;

// A normal left ventricle raises its pressure by up to about 2,000 mmHg/s (a widely quoted figure):
// 120 mmHg in 60 ms, in implicit steps of 1 ms.
constexpr double ramp_time = 60e-3;
constexpr uint32_t ramp_steps = 60;

// One load of a path: applied for one step in time, or settled to.
struct Stage {
  Load load;
  bool in_time;
};

std::vector<Stage> stages_of(const Path &path, const Load &from, const Load &to) {
  std::vector<Stage> stages;
  const bool together = path.order == LoadingOrder::together;
  const bool first = path.order == LoadingOrder::boundary_first;
  const bool moves = from.boundary_fraction != to.boundary_fraction;
  const double held = first ? to.boundary_fraction : from.boundary_fraction;
  if (first && moves) stages.push_back({{from.pressure, held}, false});
  for (uint32_t k = 1; k <= path.increments; ++k) {
    const double share = static_cast<double>(k) / path.increments;
    const double travelled =
        from.boundary_fraction + share * (to.boundary_fraction - from.boundary_fraction);
    stages.push_back(
        {{from.pressure + share * (to.pressure - from.pressure), together ? travelled : held},
         path.ramp > 0});
  }
  // the last stage is the load itself, bit for bit, and is settled to
  if (!stages.back().in_time && !(moves && path.order == LoadingOrder::pressure_first)) {
    stages.pop_back();
  }
  stages.push_back({to, false});
  return stages;
}

double force_between(const Model &model, const Load &load) {
  return between_residual * std::abs(load.pressure) * mean_area(model);
}

// Runs the stages of a path in order and adds up their statistics.
class PathRun {
 public:
  PathRun(Solver &solver, const Model &model, Closing &closing, bool plain,
          const Progress &progress)
      : solver_(solver), model_(model), closing_(closing), plain_(plain), progress_(progress) {}

  void run(const std::vector<Stage> &stages, const SolveOptions &options, double dt) {
    SolveOptions between = options, step;
    between.margins = false;
    between.residual = std::max(options.residual, force_between(model_, stages.back().load));
    if (options.solver <= SolverKind::newton) between.max_iterations = between_iterations;
    step.dt = dt;
    for (size_t k = 0; k < stages.size(); ++k) {
      closing_.state.load = stages[k].load;
      before_ = static_cast<double>(k);
      stages_ = static_cast<double>(stages.size());
      const SolveStats before = closing_.stats;
      closing_.stats =
          stages[k].in_time ? pass(step) : settle(k + 1 == stages.size() ? options : between);
      closing_.stats.add(before);
    }
  }

 private:
  SolveStats settle(const SolveOptions &how) {
    const auto tell = [this](double share, double residual) {
      return progress_((before_ + share) / stages_, residual);
    };
    const Progress shared = progress_ ? Progress(tell) : Progress();
    // the other paths stay on this mesh, so that they find its own folds
    return plain_ ? settle_with_mesh_hierarchy(solver_, model_, closing_.state, how, shared)
                  : solver_.settle(model_, closing_.state, how, shared);
  }

  SolveStats pass(const SolveOptions &how) {
    const SolveStats done = solver_.step(model_, closing_.state, how);
    MVS_MUST(!progress_ || progress_(before_ / stages_, done.residual), MVS_E_CANCELLED, "ensemble",
             "closing along paths was cancelled by the progress callback");
    return done;
  }

  Solver &solver_;
  const Model &model_;
  Closing &closing_;
  bool plain_;
  const Progress &progress_;
  double before_ = 0, stages_ = 1;  // number of stages done, and of all
};

}  // namespace

Path make_path(uint32_t number, const Disturbance &disturbance, uint64_t seed) {
  // 5 and 3 are coprime: fifteen combinations before one repeats; 0 increments: a ramp in time
  static constexpr uint32_t increments[] = {1, 4, 2, 0, 8};
  static constexpr LoadingOrder orders[] = {LoadingOrder::together, LoadingOrder::boundary_first,
                                            LoadingOrder::pressure_first};
  Path path;
  path.plain = number == 0;
  path.increments = increments[number % 5];
  if (path.increments == 0) {
    path.increments = ramp_steps;
    path.ramp = ramp_time;
  }
  path.order = orders[number % 3];
  if (!path.plain) path.disturbance = disturbance;
  path.random = Random(seed, number);
  return path;
}

Closing close_along(Solver &solver, const Model &model, const State &start, const Load &load,
                    const SolveOptions &options, const Path &path, const Progress &progress) {
  Closing closing;
  State begun = start;
  begun.rest_tolerance = 0;  // of another load or shape; the last stage finds it again
  if (path.disturbance.longest > 0) {
    closing.moved = disturb(model, begun.x.edit(), path.disturbance, path.random);
  }
  closing.state = begun;
  try {
    PathRun(solver, model, closing, path.plain, progress)
        .run(stages_of(path, start.load, load), options, path.ramp / path.increments);
    must_be_finite(closing.state);
  } catch (const Error &error) {
    if (error.code != MVS_E_DIVERGED || path.plain) throw;
    closing.diverged = true;
    closing.state = begun;
    closing.stats.converged = false;
  }
  return closing;
}

}  // namespace mvs::core
