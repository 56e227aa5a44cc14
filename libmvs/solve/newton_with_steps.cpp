// Newton's method, steps in time where it wanders, and Newton's method again.
#include "solve/newton_with_steps.h"

#include <algorithm>
#include <utility>

#include "solve/settings.h"

namespace mvs::core {

NewtonWithSteps::NewtonWithSteps(const Model &model, DirectSolver &factor, const State &state,
                                 const SolveOptions &options, const Progress &progress,
                                 MakeSteps make_steps)
    : model_(&model),
      factor_(&factor),
      options_(options),
      progress_(progress),
      make_steps_(std::move(make_steps)),
      state_(state) {
  begin_newton(state, options.most_iterations(), options.checks_stability);
}

Progress NewtonWithSteps::part() {
  if (!progress_) return {};
  return [this](double share, double residual) {
    if (!is_last_) share = std::min(share, settings::settle::settled_progress);
    share_ = std::max(share_, share);
    return progress_(share_, residual);
  };
}

void NewtonWithSteps::begin_newton(const State &state, uint32_t most, bool may_wander) {
  SolveOptions options = options_;
  options.max_iterations = most;
  newton_ = std::make_unique<NewtonSettling>(*model_, *factor_, state, options, part());
  newton_->end_where_it_wanders(may_wander);
}

bool NewtonWithSteps::advance() {
  if (steps_ ? steps_->advance() : newton_->advance()) return true;
  if (!steps_ && !newton_->wanders()) return false;
  State next = state_;
  is_last_ = false;
  SolveStats stats = steps_ ? steps_->finish(next) : newton_->finish(next);
  is_last_ = true;
  stats.add(spent_);
  spent_ = stats;
  const uint32_t left = options_.most_iterations() - spent_.iterations;
  if (!steps_) {
    // one iteration of Newton's method at least is left after them
    steps_ = make_steps_(next, std::min(left - 1, settings::newton::wander_steps), part());
  } else {
    next.time = state_.time;
    next.steps = state_.steps;
    steps_.reset();
    by_steps_ = {next, spent_};
    begin_newton(next, left, false);
  }
  return true;
}

SolveStats NewtonWithSteps::finish(State &state) {
  SolveStats stats = steps_ ? steps_->finish(state) : newton_->finish(state);
  stats.add(spent_);
  if (by_steps_ && !stats.converged && by_steps_->stats.residual < stats.residual) {
    state = std::move(by_steps_->state);
    stats.residual = by_steps_->stats.residual;
    stats.energy = by_steps_->stats.energy;
    stats.contact_pairs = by_steps_->stats.contact_pairs;
  }
  return stats;
}

}  // namespace mvs::core
