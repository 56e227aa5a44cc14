// The loop of a static closure: Newton iterations until the boundary is at its target and the valve
// at rest, a limit of iterations, the limit of a local subproblem, or iterations that move nothing,
// since all that follow are alike.
#pragma once

#include "solve/settle_watch.h"
#include "solve/settling.h"
#include "solve/static/boundary_ramp.h"
#include "solve/static/newton.h"
#include "solve/static/wander_watch.h"

namespace mvs::core {

class NewtonSettling final : public Settling {
 public:
  // The model and the factor must outlive it.
  NewtonSettling(const Model &model, DirectSolver &factor, const State &state,
                 const SolveOptions &options, const Progress &progress,
                 const LocalStart &local = {});
  bool advance() override;
  // Whether it is to end where Newton's method wanders with iterations left; not at first.
  void end_where_it_wanders(bool may) { may_wander_ = may; }
  bool wanders() const {
    return may_wander_ && wander_.wanders() && newton_.stats().iterations + 2 <= most_;
  }
  // Sets velocities to zero.
  SolveStats finish(State &state) override;
  bool begins_far_from_rest() const override;
  double largest_first_force() const override { return newton_.residual(); }

 private:
  double seconds_ = 0;
  double tolerance_;  // N
  uint32_t most_;     // iterations
  bool checks_stability_, margins_;
  bool may_presolve_;  // a local subproblem, in the first iteration
  bool eliminates_;    // settles local subproblems after iterations
  bool converged_ = false;
  Load load_;
  bool may_wander_ = false;
  WanderWatch wander_;
  uint32_t still_ = 0;  // iterations in a row that moved no node
  Newton newton_;
  BoundaryRamp ramp_;
  PolishSchedule polish_;
  SettleWatch watch_;
};

}  // namespace mvs::core
