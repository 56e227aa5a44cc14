// The loop of a static closure.
#include "solve/static/newton_settling.h"

#include "solve/nodes.h"
#include "solve/settings.h"

namespace mvs::core {

NewtonSettling::NewtonSettling(const Model &model, DirectSolver &factor, const State &state,
                               const SolveOptions &options, const Progress &progress,
                               const LocalStart &local)
    : tolerance_(options.tolerance()),
      most_(options.most_iterations()),
      checks_stability_(options.checks_stability),
      margins_(options.margins),
      load_(state.load),
      newton_(model, factor),
      ramp_(model, state.load.boundary_fraction),
      polish_{},
      watch_(model, state.x, state.load, tolerance_, progress) {
  const AddedTime timer(seconds_);
  newton_.set_poll([this] { watch_.poll(); });
  newton_.begin(state, local);
  polish_.best_residual = newton_.rest_force();
  // a local subproblem has no tools, and is not divided again
  const bool may_divide = state.tools.empty() && local.max_displacement == 0;
  may_presolve_ = may_divide && ramp_.is_there(newton_.x());
  // Under exponential laws elimination saves few iterations or costs more of them.
  eliminates_ = may_divide && has_bilinear_tissue(model);
}

bool NewtonSettling::begins_far_from_rest() const {
  return !ramp_.is_near(newton_.x()) || newton_.has_many_disturbed();
}

bool NewtonSettling::advance() {
  const AddedTime timer(seconds_);
  if (may_presolve_) newton_.presolve_locally(load_);
  may_presolve_ = false;
  const bool arrived = ramp_.is_there(newton_.x());
  const bool balanced = arrived && newton_.residual() <= tolerance_;
  converged_ = balanced && (!checks_stability_ || newton_.is_stable(margins_));
  if (converged_ || newton_.stats().iterations == most_ || newton_.reached_limit()) return false;
  if (newton_.always_returns() || wanders()) return false;
  if (still_ > settings::newton::most_still) return false;
  watch_.look(newton_.x(), newton_.residual());
  ++newton_.stats().iterations;
  if (!arrived && ramp_.may_move(newton_.residual(), newton_.rest_force())) {
    newton_.move_boundary(ramp_);
  }
  const std::vector<Vec3> before = newton_.x();
  newton_.iterate(polish_);
  if (eliminates_ && arrived) newton_.eliminate(load_, tolerance_);
  if (arrived) {
    wander_.look(newton_.stats().iterations, newton_.energy(), newton_.residual());
  }
  still_ = same_bits(before, newton_.x()) ? still_ + 1 : 0;
  return true;
}

SolveStats NewtonSettling::finish(State &state) {
  watch_.finish(newton_.residual());
  SolveStats stats = newton_.finish(state);
  stats.converged = converged_;
  stats.wall_s = seconds_;
  return stats;
}

}  // namespace mvs::core
