// Steps in time until the out-of-balance force is below the tolerance for several steps in a row,
// at a stable equilibrium; an unstable one is left.
#pragma once

#include "solve/dynamic/time_step.h"
#include "solve/settings.h"
#include "solve/settle_watch.h"
#include "solve/settling.h"
#include "solve/stability.h"
#include "solve/static/boundary_ramp.h"

namespace mvs::core {

// `Stepper`: ImplicitEuler or ExplicitEuler.
template <typename Stepper>
class SettlingInTime final : public Settling {
 public:
  SettlingInTime(const Model &model, std::unique_ptr<Stepper> stepper, State state,
                 const StepOptions &how, uint32_t most, double tolerance, const Progress &progress)
      : model_(&model),
        stepper_(std::move(stepper)),
        state_(std::move(state)),
        how_(how),
        most_(most),
        tolerance_(tolerance),
        watch_(model, state_.x, state_.load, tolerance, progress) {}

  bool advance() override {
    const AddedTime timer(stats_.wall_s);
    if (calm_ == settings::settle::calm_steps && is_stable()) return false;
    if (stats_.iterations == most_) return false;
    ++stats_.iterations;
    stepper_->step(state_, how_, stats_);
    state_.time += how_.dt;
    ++state_.steps;
    const bool at_rest = stats_.residual <= tolerance_ &&
                         boundary_is_there(*model_, state_.x, state_.load.boundary_fraction,
                                           settings::settle::boundary_arrival);
    calm_ = at_rest ? calm_ + 1 : 0;
    if (stats_.iterations % settings::settle::steps_per_report == 0) {
      watch_.look(state_.x, stats_.residual);
    }
    return true;
  }

  SolveStats finish(State &state) override {
    watch_.finish(stats_.residual);
    stats_.converged = stats_.stable;
    stats_.kinetic = 0;
    stats_.skipped = stepper_->skipped();
    state_.v.assign(state_.v.size(), Vec3::Zero());
    state = std::move(state_);
    return stats_;
  }

 private:
  // If not, the valve leaves the equilibrium.
  bool is_stable() {
    const Stability found =
        check_stability(*model_, state_, Stepper::contact_law, true, how_.margins);
    stats_.stable = found.is_stable;
    stats_.stiffness_margin = found.stiffness;
    stats_.growth_rate = found.rate;
    if (!found.is_stable) calm_ = 0;
    return found.is_stable;
  }

  const Model *model_;
  std::unique_ptr<Stepper> stepper_;
  State state_;
  StepOptions how_;
  uint32_t most_;
  double tolerance_;  // N
  SettleWatch watch_;
  SolveStats stats_;
  int calm_ = 0;  // steps in a row
};

}  // namespace mvs::core
