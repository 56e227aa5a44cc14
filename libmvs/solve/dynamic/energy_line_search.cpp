// Trials of the energy line search.
#include "solve/dynamic/energy_line_search.h"

#include <algorithm>
#include <cmath>

#include "solve/settings.h"
#include "solve/step_settings.h"

namespace mvs::core {

void scatter_step(const StepMatrix &matrix, const std::vector<Vec3> &rows,
                  const BoundaryStep &boundary, std::vector<Vec3> &displacement, double share) {
  displacement = boundary.displacement;
  for (uint32_t r = 0; r < rows.size(); ++r) displacement[matrix.node(r)] = share * rows[r];
}

namespace {

// The derivative of the energy along the displacement of a step, J.
double slope_along(const StepStart &start, const ProposedStep &step) {
  double slope = 0;
  for (size_t i = 0; i < start.x.size(); ++i) slope += start.gradient[i].dot(step.displacement[i]);
  return slope;
}

// The share of rows that moves no node by more than the longest displacement.
double longest_share(const std::vector<Vec3> &rows) {
  double farthest = settings::implicit::max_displacement;
  for (const Vec3 &row : rows) farthest = std::max(farthest, row.norm());
  return settings::implicit::max_displacement / farthest;
}

}  // namespace

EnergyLineSearch::EnergyLineSearch(const Model &model, TotalEnergy &total_energy)
    : model_(&model), total_energy_(&total_energy) {
  // a step allocates nothing once warm, also if the boundary moves only then
  boundary_x_.reserve(model.node_count());
  boundary_gradient_.reserve(model.node_count());
}

bool EnergyLineSearch::run(const StepStart &start, ProposedStep &step, StepWork &work) {
  namespace set = settings::implicit;
  boundary_energy_ = -1;
  const double slope = slope_along(start, step);
  double share = 1;
  for (int k = 0; k < set::trials && work.left >= set::reserved_passes; ++k) {
    const double made = try_share(share, start, step, work);
    if (made <= 0) return true;
    // the limited step leads uphill, however short it is
    if (slope >= 0) break;
    const double bend = made + kinetic_energy(*model_, start.v) - slope * share;
    const double lowest = -slope * share / (2 * bend);  // of the parabola, as a share of this one
    if (lowest <= set::min_share) break;
    share *= std::min(lowest, set::max_share);
  }
  work.stats.lowered |= MVS_LOWERED_STEP;
  return search_shorter_step(start, step, work);
}

bool EnergyLineSearch::search_shorter_step(const StepStart &start, ProposedStep &step,
                                           StepWork &work) {
  namespace set = settings::implicit;
  double share = longest_share(step.rows);
  for (int k = 0; k < set::quarterings && work.left >= set::reserved_passes; ++k) {
    share *= 0.25;
    scatter_step(step.matrix, step.rows, step.boundary, step.displacement, share);
    total_energy_->limit_step(start.x, step.slack, step.displacement, work.stats.work);
    if (try_share(1, start, step, work) <= 0) return true;
  }
  // the last trial hardly differs from the step of the boundary alone
  return step.boundary.moves;
}

// Sets the trial at a share of the step and returns the energy that it makes beyond rounding and
// beyond the energy that the boundary alone would make, J; at most 0: it may be accepted.
double EnergyLineSearch::try_share(double share, const StepStart &start, const ProposedStep &step,
                                   StepWork &work) {
  const double before = start.energy + kinetic_energy(*model_, start.v);
  place(share, start, step, work.how.dt);
  --work.left;
  const double after =
      total_energy_->sheet_gradient(trial.x, trial.sheet_gradient, work.stats.work) +
      total_energy_->hands_energy(trial.x) + trial.kinetic;
  const double made = after - before - settings::implicit::energy_rounding * std::abs(before);
  if (!step.boundary.moves || made <= 0) return made;
  if (boundary_energy_ < 0) {
    if (work.left < 2) return 0;  // accepted where the budget ends
    work.left -= 2;
    boundary_energy_ = boundary_energy(start, step.boundary, work.stats);
    // the total energy keeps data of its last evaluation, which has to be the trial
    total_energy_->sheet_gradient(trial.x, trial.sheet_gradient, work.stats.work);
  }
  return made - boundary_energy_;
}

// Returns the energy that the boundary step makes where no free node moves.
double EnergyLineSearch::boundary_energy(const StepStart &start, const BoundaryStep &boundary,
                                         SolveStats &stats) {
  boundary_x_ = start.x;
  for (size_t i = 0; i < start.x.size(); ++i) {
    if (model_->topology.fixed[i]) boundary_x_[i] += boundary.displacement[i];
  }
  const double energy = total_energy_->sheet_gradient(boundary_x_, boundary_gradient_, stats.work) +
                        total_energy_->hands_energy(boundary_x_);
  return std::max(energy - start.energy, 0.0);
}

void EnergyLineSearch::place(double share, const StepStart &start, const ProposedStep &step,
                             double dt) {
  const size_t nodes = start.x.size();
  trial.x.resize(nodes);
  trial.v.resize(nodes);
  for (size_t i = 0; i < nodes; ++i) {
    trial.x[i] = start.x[i] + share * step.displacement[i];
    trial.v[i] = (share / dt) * step.displacement[i];
  }
  trial.kinetic = kinetic_energy(*model_, trial.v);
  if (share != 1) return;
  // a boundary that arrives ends on its target, bit for bit
  for (uint32_t i = 0; i < nodes; ++i) {
    if (!model_->topology.fixed[i]) continue;
    if (step.displacement[i] != step.boundary.displacement[i]) continue;
    const Vec3 target = model_->target(i, start.load.boundary_fraction);
    if ((trial.x[i] - target).norm() < settings::boundary::snap_distance) trial.x[i] = target;
  }
}

}  // namespace mvs::core
