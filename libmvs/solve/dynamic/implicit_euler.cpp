// The implicit step, top to bottom.
#include "solve/dynamic/implicit_euler.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "solve/nodes.h"

namespace mvs::core {
namespace {

// Of the force of the pressure on a mean node: more, and the boundary waits. Of nine moving annuli
// with exponential laws, in 40 live steps each, six stay below 13 N with it, two have single steps
// of 2e3 and 3e3 N; with 100 one has 8e5.
constexpr double overstretched = 10;
constexpr uint64_t steps_to_wait = 20;

constexpr double longest_step = 1e-3;                  // m a node may go in one step
constexpr int trials = 8;                              // of shares of a step that was cut
constexpr double least_share = 0.1, most_share = 0.5;  // of the share tried before
constexpr int quarterings = 12;                        // of a step before it is cut
constexpr uint32_t closing_passes = StepSolver::closing;
// Of the contact thickness: where no node goes farther, pairs that no list of candidates has to
// hold cannot be cut either, and one made for an earlier step serves.
constexpr double slow = 0.02;

void take_pushing(const std::vector<Tool> &tools, std::vector<Tool> &pushing) {
  pushing.clear();
  for (const Tool &tool : tools) {
    if (tool.points() > 0) pushing.push_back(tool);
  }
}

// Whether the tools that push are these.
bool pushes(const std::vector<Tool> &tools, const std::vector<Tool> &pushing) {
  size_t k = 0;
  for (const Tool &tool : tools) {
    if (tool.points() == 0) continue;
    if (k == pushing.size() || !tool.is_same_as(pushing[k++])) return false;
  }
  return k == pushing.size();
}

}  // namespace

double rest_force(const Load &load) {
  return std::min(1.0001e-5, 1e-9 + 1e-5 / MVS_SYSTOLE_PA * std::abs(load.pressure));
}

ImplicitEuler::ImplicitEuler(const Model &model, uint32_t backend)
    : model_(&model),
      total_energy_(model),
      matrix_(model),
      solver_(model, total_energy_, backend),
      slack_(0.1 * model.valve.contact_thickness) {
  // no memory is asked for once warm, also if the boundary moves only then
  alone_x_.reserve(model.node_count());
  alone_g_.reserve(model.node_count());
}

void ImplicitEuler::make_ready(State &state, const StepOptions &how) {
  SolveStats unseen;
  total_energy_.keep_near_at_once();
  resume(state, how);
  begin(state, how, unseen);
  if (how.may_sleep && is_at_rest(state, how)) return;
  matrix_.assemble(total_energy_, x_, how, nullptr, unseen.work);
  solver_.make_ready(matrix_, here(state, how), x_);
}

void ImplicitEuler::step(State &state, const StepOptions &how, SolveStats &stats) {
  resume(state, how);
  begin(state, how, stats);
  if (how.may_sleep && is_at_rest(state, how)) {
    const auto stands = [](const Vec3 &v) { return v.isZero(0); };
    if (!std::all_of(v_.begin(), v_.end(), stands)) {
      std::fill(v_.begin(), v_.end(), Vec3::Zero());
      state.v.edit() = v_;
    }
    kinetic_ = 0;
    stats.skipped |= MVS_SKIPPED_STEP;
    report(stats);
    return;
  }
  solve(state, how, stats);
  limit(stats);
  if (go(how, stats)) {
    x_.swap(next_x_);
    v_.swap(next_v_);
    sheet_g_.swap(next_g_);
    sheet_energy_ = total_energy_.freeze(x_);
    sum_up();
  } else {
    stand();
    evaluate(stats);  // contact is known at the last place tried
  }
  state.x.edit() = x_;
  state.v.edit() = v_;
  report(stats);
}

// A solver that has not made the steps before makes the factors that they have left.
void ImplicitEuler::resume(State &state, const StepOptions &how) {
  solver_.resume(state, how, matrix_, [&](const PreconditionerKey &place, StepMatrix &matrix) {
    look(place, how, matrix);
  });
}

void ImplicitEuler::look(const PreconditionerKey &place, const StepOptions &how,
                         StepMatrix &matrix) {
  evaluated_ = false;
  Profile unseen{};
  total_energy_.set_pressure(place.pressure);
  total_energy_.set_tools(place.tools);
  total_energy_.prepare(place.x, place.x, slack_, unseen);
  total_energy_.sheet_gradient(place.x, next_g_, unseen);
  matrix.assemble(total_energy_, place.x, how, nullptr, unseen);
}

// Forces of the step before are those of this one, where it goes on from there.
void ImplicitEuler::begin(const State &state, const StepOptions &how, SolveStats &stats) {
  left_ = how.budget;
  evaluated_ = evaluated_ && state.load.pressure == load_.pressure &&
               pushes(state.tools, pushing_) && same_bits(x_, state.x);
  load_ = state.load;
  x_ = state.x.get();
  v_ = state.v.get();
  total_energy_.set_pressure(load_.pressure);
  total_energy_.set_tools(state.tools);
  travels_ = advance_boundary(*model_, state, how.dt, boundary_);
  if (evaluated_) {
    sum_up();
  } else {
    take_pushing(state.tools, pushing_);
    evaluate(stats);
  }
  if (travels_ && is_overstretched(state)) {
    travels_ = false;
    std::fill(boundary_.begin(), boundary_.end(), Vec3::Zero());
  }
}

// Whether the sheet is to give way before the boundary goes on: where forces are so large, tissue
// that stiffens exponentially is stretched as far as it can be. Not for good, for what is stuck may
// need the boundary to get free.
bool ImplicitEuler::is_overstretched(const State &state) const {
  return residual_ > overstretched * scale_of(state.load) * mean_area(*model_) &&
         state.steps % steps_to_wait != 0;
}

void ImplicitEuler::evaluate(SolveStats &stats) {
  evaluated_ = false;
  if (!total_energy_.prepared_for(x_)) total_energy_.prepare(x_, x_, slack_, stats.work);
  total_energy_.sheet_gradient(x_, sheet_g_, stats.work);
  sheet_energy_ = total_energy_.freeze(x_);
  sum_up();
}

// Hands may move while the sheet stays.
void ImplicitEuler::sum_up() {
  evaluated_ = false;
  g_ = sheet_g_;
  energy_ = sheet_energy_ + total_energy_.add_hands(x_, g_);
  residual_ = largest_free(*model_, g_);
  MVS_MUST(std::isfinite(energy_) && std::isfinite(residual_), MVS_E_DIVERGED, "step",
           "the forces are not finite: nodes coincide or the material is too stiff");
  evaluated_ = true;
}

// Whether nothing drives the valve: neither out-of-balance forces, nor, in the same unit, what is
// left of its motion.
bool ImplicitEuler::is_at_rest(const State &state, const StepOptions &how) const {
  const double most = rest_force(state.load);
  if (travels_ || residual_ > most) return false;
  for (size_t i = 0; i < v_.size(); ++i) {
    if (model_->topology.fixed[i] || v_[i].isZero(0)) continue;
    if (!(model_->node_mass[i] * v_[i].norm() <= most * how.dt)) return false;
  }
  return true;
}

void ImplicitEuler::solve(State &state, const StepOptions &how, SolveStats &stats) {
  matrix_.assemble(total_energy_, x_, how, travels_ ? &boundary_ : nullptr, stats.work);
  --left_;
  rows_.resize(matrix_.size());
  for (uint32_t r = 0; r < matrix_.size(); ++r) {
    const uint32_t i = matrix_.node(r);
    rows_[r] = matrix_.boundary_force()[r] - g_[i] + (model_->node_mass[i] / how.dt) * v_[i];
  }
  solver_.solve(matrix_, here(state, how), x_, state, rows_, left_, stats);
}

PreconditionerKey ImplicitEuler::here(const State &state, const StepOptions &how) const {
  return {{}, state.tools, load_.pressure, how.dt, how.damping, 0};
}

void ImplicitEuler::limit(SolveStats &stats) {
  step_ = boundary_;
  for (size_t r = 0; r < rows_.size(); ++r)
    step_[matrix_.node(static_cast<uint32_t>(r))] = rows_[r];
  total_energy_.instrument().bodies().shorten(step_, longest_step);
  double farthest = 0;
  for (size_t i = 0; i < x_.size(); ++i) {
    const double length = step_[i].norm();
    if (length > longest_step) step_[i] *= longest_step / length;
    farthest = std::max(farthest, std::min(length, longest_step));
  }
  next_x_.resize(x_.size());
  for (size_t i = 0; i < x_.size(); ++i) next_x_[i] = x_[i] + step_[i];
  const double quick = slow * model_->valve.contact_thickness;
  // what moves needs another list in the next step anyway: the shortest one will do
  list_slack_ = farthest > quick ? quick : slack_;
  if (farthest > quick || !total_energy_.prepared_for(next_x_) || !total_energy_.prepared_for(x_)) {
    total_energy_.prepare(x_, next_x_, list_slack_, stats.work);
  }
  total_energy_.limit_step(x_, list_slack_, step_, stats.work);
}

// Goes a share of the step that makes no energy: it may come from the pressure (part of the
// potential) and the boundary, from nowhere else. False if there is none. Where a whole step is too
// much, the parabola of its slope, its start and its end tells how much may do. Where that is next
// to nothing, the cuts have left a step across the slope: a ball that was drawn back stuck in the
// tissue as long as such steps were followed.
bool ImplicitEuler::go(const StepOptions &how, SolveStats &stats) {
  double share = 1, slope = 0;
  boundary_made_ = -1;
  for (size_t i = 0; i < x_.size(); ++i) slope += g_[i].dot(step_[i]);
  for (int k = 0; k < trials && left_ >= closing_passes; ++k) {
    const double made = goes(share, how.dt, stats);
    if (made <= 0) return true;
    // cut node by node it leads uphill, however little of it is gone,
    if (slope >= 0) break;
    const double bend = made + kinetic_energy(*model_, v_) - slope * share;
    const double lowest = -slope * share / (2 * bend);  // of the parabola, in shares of this one
    if (lowest <= least_share) break;
    share *= std::min(lowest, most_share);
  }
  stats.lowered |= MVS_LOWERED_STEP;
  return go_less(how, stats);
}

// Shortened as a whole the step leads downhill, and the shorter it is, the less of it is cut.
bool ImplicitEuler::go_less(const StepOptions &how, SolveStats &stats) {
  double farthest = longest_step;
  for (const Vec3 &row : rows_) farthest = std::max(farthest, row.norm());
  double share = longest_step / farthest;
  for (int k = 0; k < quarterings && left_ >= closing_passes; ++k) {
    share *= 0.25;
    step_ = boundary_;
    for (size_t r = 0; r < rows_.size(); ++r)
      step_[matrix_.node(static_cast<uint32_t>(r))] = share * rows_[r];
    total_energy_.limit_step(x_, list_slack_, step_, stats.work);
    if (goes(1, how.dt, stats) <= 0) return true;
  }
  return travels_;  // the last one hardly differs from what the boundary does alone
}

// The energy that a share of the step makes beyond rounding, and beyond what a boundary on its way
// would make alone, at most 0 if it may be gone; where it leads is in next_x_ and next_v_, the
// forces there in next_g_.
double ImplicitEuler::goes(double share, double dt, SolveStats &stats) {
  const double before = energy_ + kinetic_energy(*model_, v_);
  place(share, dt);
  --left_;
  const double after = total_energy_.sheet_gradient(next_x_, next_g_, stats.work) +
                       total_energy_.hands_energy(next_x_) + kinetic_;
  const double made = after - before - 1e-12 * std::abs(before);
  if (!travels_ || made <= 0) return made;
  if (boundary_made_ < 0) {
    if (left_ < 2) return 0;  // as far as the budget goes
    left_ -= 2;
    boundary_made_ = boundary_alone(stats);
    // what is known of a place is to be of this one again
    total_energy_.sheet_gradient(next_x_, next_g_, stats.work);
  }
  return made - boundary_made_;
}

// The energy that the step of the boundary makes where nothing gives way to it.
double ImplicitEuler::boundary_alone(SolveStats &stats) {
  alone_x_ = x_;
  for (size_t i = 0; i < x_.size(); ++i) {
    if (model_->topology.fixed[i]) alone_x_[i] += boundary_[i];
  }
  const double energy = total_energy_.sheet_gradient(alone_x_, alone_g_, stats.work) +
                        total_energy_.hands_energy(alone_x_);
  return std::max(energy - energy_, 0.0);
}

void ImplicitEuler::place(double share, double dt) {
  next_x_.resize(x_.size());
  next_v_.resize(x_.size());
  for (size_t i = 0; i < x_.size(); ++i) {
    next_x_[i] = x_[i] + share * step_[i];
    next_v_[i] = (share / dt) * step_[i];
  }
  kinetic_ = kinetic_energy(*model_, next_v_);
  if (share == 1) arrive();
}

void ImplicitEuler::stand() {
  std::fill(v_.begin(), v_.end(), Vec3::Zero());
  kinetic_ = 0;
}

// A boundary that has come to its target is there to the bit.
void ImplicitEuler::arrive() {
  for (uint32_t i = 0; i < x_.size(); ++i) {
    if (!model_->topology.fixed[i] || step_[i] != boundary_[i]) continue;
    const Vec3 target = model_->target(i, load_.boundary_fraction);
    if ((next_x_[i] - target).norm() < 1e-12) next_x_[i] = target;
  }
}

void ImplicitEuler::report(SolveStats &stats) const {
  stats.residual = residual_;
  stats.energy = energy_;
  stats.kinetic = kinetic_;
  stats.contact_pairs = static_cast<uint32_t>(total_energy_.contact().contact_pairs().size());
}

}  // namespace mvs::core
