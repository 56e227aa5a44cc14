// The implicit step: forces, linear system, step limits, energy line search.
#include "solve/dynamic/implicit_euler.h"

#include <algorithm>
#include <cmath>

#include "solve/nodes.h"
#include "solve/settings.h"
#include "solve/step_settings.h"

namespace mvs::core {

void ImplicitEuler::step(State &state, const StepOptions &how, SolveStats &stats) {
  StepWork work{how, stats, how.budget};
  resume(state, how);
  begin(state, work);
  if (how.may_sleep && is_at_rest(how)) return sleep(state, stats);
  solve_linear_system(state, work);
  const double slack = limit_step(stats);
  ProposedStep proposed{matrix_, rows_, boundary_, slack, displacement_};
  if (line_search_.run(start_, proposed, work)) {
    start_.accept(*model_, total_energy_, line_search_.trial);
  } else {
    start_.stop();
    // the last evaluation of the total energy was a rejected trial
    start_.evaluate(*model_, total_energy_, slack_, stats);
  }
  state.x.edit() = start_.x;
  state.v.edit() = start_.v;
  report(stats);
}

// A solver that has not made the steps before makes the factors that the solver cache names.
void ImplicitEuler::resume(State &state, const StepOptions &how) {
  const auto assemble = [&](const PreconditionerKey &key, StepMatrix &matrix) {
    start_.is_evaluated = false;
    Profile unseen{};
    total_energy_.set_pressure(key.pressure);
    total_energy_.set_tools(key.tools);
    total_energy_.prepare(key.x, key.x, slack_, unseen);
    total_energy_.sheet_gradient(key.x, line_search_.trial.sheet_gradient, unseen);
    matrix.assemble(total_energy_, key.x, how, nullptr, unseen);
  };
  solver_.resume(state, how, matrix_, assemble);
}

// Positions, velocities and forces at the start, and the step of the boundary. The boundary waits
// while forces are so large that exponentially stiffening tissue is stretched to its limit; not for
// ever, because tissue that is stuck may need the boundary to get free.
void ImplicitEuler::begin(const State &state, StepWork &work) {
  namespace set = settings::boundary;
  start_.begin(*model_, total_energy_, state, slack_, work.stats);
  next_boundary_step(*model_, start_.x, state.load.boundary_fraction, set::max_speed * work.how.dt,
                     boundary_);
  const auto is_overstretched = [&] {
    return start_.residual > set::max_live_residual * scale_of(state.load) * mean_area(*model_);
  };
  if (boundary_.moves && is_overstretched() && state.steps % set::max_live_wait != 0) {
    boundary_.cancel();
  }
}

bool ImplicitEuler::is_at_rest(const StepOptions &how) const {
  return !boundary_.moves && start_.is_at_rest(*model_, how.dt);
}

void ImplicitEuler::sleep(State &state, SolveStats &stats) {
  const auto stands = [](const Vec3 &v) { return v.isZero(0); };
  if (!std::all_of(start_.v.begin(), start_.v.end(), stands)) {
    start_.stop();
    state.v.edit() = start_.v;
  }
  start_.kinetic = 0;
  stats.skipped |= MVS_SKIPPED_STEP;
  report(stats);
}

void ImplicitEuler::solve_linear_system(State &state, StepWork &work) {
  const StepOptions &how = work.how;
  matrix_.assemble(total_energy_, start_.x, how,
                   boundary_.moves ? &boundary_.displacement : nullptr, work.stats.work);
  --work.left;
  matrix_.right_side(start_.gradient, start_.v, how.dt, rows_);
  solver_.solve({matrix_, key_here(state, how), start_.x, rows_}, state, work);
}

PreconditionerKey ImplicitEuler::key_here(const State &state, const StepOptions &how) const {
  return {{}, state.tools, start_.load.pressure, how.dt, how.damping, 0};
}

// Sets the displacement of all nodes: the solution of the linear system and the boundary step, each
// node at most the longest displacement, without collision. Returns the slack of the broad phase.
double ImplicitEuler::limit_step(SolveStats &stats) {
  namespace set = settings::implicit;
  scatter_step(matrix_, rows_, boundary_, displacement_, 1);
  const InstrumentBodies &instruments = total_energy_.instrument().bodies();
  instruments.shorten(displacement_, set::max_instrument_displacement);
  const std::vector<Vec3> &x = start_.x;
  std::vector<Vec3> &to = line_search_.trial.x;
  to.resize(x.size());
  double farthest = 0;
  for (size_t i = 0; i < x.size(); ++i) {
    const double length = displacement_[i].norm();
    const double most =
        i < instruments.first_point() ? set::max_displacement : set::max_instrument_displacement;
    if (length > most) {
      displacement_[i] *= most / length;
      stats.lowered |= MVS_LOWERED_STEP;
    }
    farthest = std::max(farthest, std::min(length, most));
    to[i] = x[i] + displacement_[i];
  }
  const double slow = set::slow_displacement * model_->valve.contact_thickness;
  // a moving valve needs another broad phase in the next step anyway: the least slack serves
  const double slack = farthest > slow ? slow : slack_;
  if (farthest > slow || !total_energy_.prepared_for(to) || !total_energy_.prepared_for(x)) {
    total_energy_.prepare(x, to, slack, stats.work);
  }
  total_energy_.limit_step(x, slack, displacement_, stats.work);
  // `to` is still the step before that
  for (size_t i = 0; i < x.size() && (stats.lowered & MVS_LOWERED_STEP) == 0; ++i) {
    if (x[i] + displacement_[i] != to[i]) stats.lowered |= MVS_LOWERED_STEP;
  }
  return slack;
}

ImplicitEuler::ImplicitEuler(const Model &model, Backend backend, Workers *workers)
    : model_(&model),
      total_energy_(model),
      matrix_(model),
      solver_(model, total_energy_, backend),
      line_search_(model, total_energy_),
      slack_(settings::implicit::broad_phase_slack * model.valve.contact_thickness) {
  total_energy_.use_workers(workers);
}

void ImplicitEuler::make_ready(State &state, const StepOptions &how) {
  SolveStats unseen;
  StepWork work{how, unseen, how.budget};
  total_energy_.use_verlet_list_at_once();
  resume(state, how);
  begin(state, work);
  if (how.may_sleep && is_at_rest(how)) return;
  matrix_.assemble(total_energy_, start_.x, how, nullptr, unseen.work);
  solver_.make_ready({matrix_, key_here(state, how), start_.x, rows_});
}

void ImplicitEuler::report(SolveStats &stats) const {
  stats.residual = start_.residual;
  stats.energy = start_.energy;
  stats.kinetic = start_.kinetic;
  stats.contact_pairs = static_cast<uint32_t>(total_energy_.contact().contact_pairs().size());
}

}  // namespace mvs::core
