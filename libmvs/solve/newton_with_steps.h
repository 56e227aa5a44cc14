// A static closure that goes on in time where Newton's method wanders: the inertia of the valve
// leads it out of the cycle, to a fold in which it comes to rest. Newton's method then finishes.
//
// A valve may have no stable equilibrium there: its free edge flutters around an unstable one under
// the pressure that follows it, by some um in time, by 1 mm between iterations of Newton's method.
// The settle then ends with the shape that the steps in time have reached, and not converged.
#pragma once

#include <memory>
#include <optional>

#include "solve/settling.h"
#include "solve/static/newton_settling.h"

namespace mvs::core {

class NewtonWithSteps final : public Settling {
 public:
  // Makes the loop of steps in time from a state, with so many steps at most.
  using MakeSteps =
      std::function<std::unique_ptr<Settling>(State, uint32_t most, const Progress &)>;

  // The model and the factor must outlive it.
  NewtonWithSteps(const Model &model, DirectSolver &factor, const State &state,
                  const SolveOptions &options, const Progress &progress, MakeSteps make_steps);
  bool advance() override;
  SolveStats finish(State &state) override;
  bool begins_far_from_rest() const override { return newton_->begins_far_from_rest(); }
  double largest_first_force() const override { return newton_->largest_first_force(); }

 private:
  // The progress of one of the loops: that of the whole never falls, and is 1 at its end only.
  Progress part();
  void begin_newton(const State &state, uint32_t most, bool may_wander);

  // A shape that a loop ended with.
  struct Reached {
    State state;
    SolveStats stats;
  };

  const Model *model_;
  DirectSolver *factor_;
  SolveOptions options_;
  Progress progress_;
  MakeSteps make_steps_;
  State state_;       // that the present loop began with
  SolveStats spent_;  // of the loops before
  std::optional<Reached> by_steps_;
  double share_ = 0;     // of the progress, reported last
  bool is_last_ = true;  // no loop follows the present one
  std::unique_ptr<NewtonSettling> newton_;
  std::unique_ptr<Settling> steps_;  // null: Newton's method is running
};

}  // namespace mvs::core
