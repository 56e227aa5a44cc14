// The two steps in time, each top to bottom.
#include "physics/stepper.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "physics/nodes.h"

namespace mvs {
namespace {

constexpr double longest_step = 1e-3;  // m a node may go in one implicit step
constexpr int halvings = 6;
constexpr double farthest_step = 1;  // m; beyond it an explicit step has blown up

}  // namespace

double kinetic_energy(const Model &model, const std::vector<Vec3> &v) {
  double sum = 0;
  for (size_t i = 0; i < v.size(); ++i) sum += 0.5 * model.node_mass[i] * v[i].squaredNorm();
  return sum;
}

void advance_boundary(const Model &model, const State &state, double dt, std::vector<Vec3> &step) {
  step.assign(state.x.size(), Vec3::Zero());
  double farthest = 0;
  for (uint32_t i = 0; i < state.x.size(); ++i) {
    if (!model.topology.fixed[i]) continue;
    step[i] = model.target(i, state.load.boundary_fraction) - state.x[i];
    farthest = std::max(farthest, step[i].norm());
  }
  const double share = farthest > boundary_speed * dt ? boundary_speed * dt / farthest : 1.0;
  for (Vec3 &s : step) s *= share;
}

ImplicitStepper::ImplicitStepper(const Model &model, Factor &factor)
    : model_(&model),
      factor_(&factor),
      potential_(model),
      slack_(0.1 * model.valve.contact_thickness) {}

void ImplicitStepper::evaluate(SolveStats &stats) {
  if (!potential_.prepared_for(x_)) potential_.prepare(x_, x_, slack_, stats.work);
  energy_ = potential_.gradient(x_, g_, stats.work);
  residual_ = largest_free(*model_, g_);
  MVS_MUST(std::isfinite(energy_) && std::isfinite(residual_), MVS_E_DIVERGED, "step",
           "the forces are not finite: nodes coincide or the material is too stiff");
}

void ImplicitStepper::step(State &state, double dt, double damping, SolveStats &stats) {
  potential_.set_pressure(state.load.pressure);
  potential_.set_tools(state.tools.get());
  x_ = state.x;
  v_ = state.v;
  advance_boundary(*model_, state, dt, boundary_);
  evaluate(stats);
  solve(dt, damping, stats);
  limit(stats);
  // energy may come from the pressure (part of the potential) and the boundary, from nowhere else
  const double before = energy_ + kinetic_energy(*model_, v_);
  const bool free_of_work =
      std::all_of(boundary_.begin(), boundary_.end(), [](const Vec3 &b) { return b.isZero(0); });
  double share = 1;
  for (int k = 0; k <= halvings; ++k, share *= 0.5) {
    for (size_t i = 0; i < x_.size(); ++i) {
      state.x[i] = x_[i] + share * step_[i];
      state.v[i] = (share / dt) * step_[i];
    }
    ++stats.work.passes;
    const double after = potential_.energy(state.x) + kinetic_energy(*model_, state.v);
    if (!free_of_work || after <= before + 1e-12 * std::abs(before)) break;
  }
  for (uint32_t i = 0; share == 1 && i < x_.size(); ++i) {
    const bool arrives = model_->topology.fixed[i] && step_[i] == boundary_[i];
    const Vec3 target = model_->target(i, state.load.boundary_fraction);
    if (arrives && (state.x[i] - target).norm() < 1e-12) state.x[i] = target;
  }
  x_ = state.x;
  evaluate(stats);
  stats.residual = residual_;
  stats.energy = energy_;
  stats.kinetic = kinetic_energy(*model_, state.v);
  stats.contact_pairs = static_cast<uint32_t>(potential_.contact().stencils().size());
}

void ImplicitStepper::solve(double dt, double damping, SolveStats &stats) {
  // a new pattern each step: the order of elimination, and with it the last bits, then depends on
  // the state alone and not on the steps that led to it
  system_ = System();
  system_.boundary_step = &boundary_;
  if (potential_.hessian(x_, Curvature::projected, system_, stats.work)) {
    const PhaseTimer timer(stats.work, MVS_PHASE_ORDERING);
    factor_->analyse(system_.matrix);
  }
  system_.boundary_step = nullptr;
  rows_.resize(system_.node_of.size());
  for (size_t r = 0; r < rows_.size(); ++r) {
    const uint32_t i = system_.node_of[r];
    rows_[r] = system_.boundary_force[r] - g_[i] + (model_->node_mass[i] / dt) * v_[i];
  }
  const PhaseTimer timer(stats.work, MVS_PHASE_FACTOR);
  std::vector<Mat3> diagonal(rows_.size());
  for (size_t r = 0; r < rows_.size(); ++r)
    diagonal[r] = system_.matrix.value[system_.matrix.start[r]];
  // more mass where the pressure makes the matrix indefinite: a smaller step in disguise
  for (double factor = 1;; factor *= 4) {
    for (size_t r = 0; r < rows_.size(); ++r) {
      const double m = model_->node_mass[system_.node_of[r]];
      Mat3 &block = system_.matrix.value[system_.matrix.start[r]];
      block = diagonal[r];
      block.diagonal().array() += factor * m * (1 / (dt * dt) + damping / dt);
    }
    ++stats.factorisations;
    if (factor_->factorise(system_.matrix)) break;
    ++stats.shifted;
    MVS_MUST(factor < 1e18, MVS_E_DIVERGED, "step", "the stiffness matrix is not finite");
  }
  factor_->solve(rows_);
}

void ImplicitStepper::limit(SolveStats &stats) {
  step_ = boundary_;
  for (size_t r = 0; r < rows_.size(); ++r) step_[system_.node_of[r]] = rows_[r];
  potential_.instrument().shorten(step_, longest_step);
  for (Vec3 &d : step_) {
    const double length = d.norm();
    if (length > longest_step) d *= longest_step / length;
  }
  potential_.limit_step(x_, slack_, step_, stats.work);
}

ExplicitStepper::ExplicitStepper(const Model &model)
    : model_(&model), potential_(model, ContactLaw::penalty) {}

void ExplicitStepper::step(State &state, double dt, double damping, SolveStats &stats) {
  potential_.set_pressure(state.load.pressure);
  potential_.set_tools(state.tools.get());
  if (!potential_.prepared_for(state.x)) {
    potential_.prepare(state.x, state.x, 0.5 * model_->valve.contact_thickness, stats.work);
  }
  stats.energy = potential_.gradient(state.x, g_, stats.work);
  stats.residual = largest_free(*model_, g_);
  std::vector<Vec3> boundary;
  advance_boundary(*model_, state, dt, boundary);
  bool sane = std::isfinite(stats.residual);
  for (uint32_t i = 0; i < state.x.size(); ++i) {
    if (model_->topology.fixed[i]) {
      state.v[i] = boundary[i] / dt;
      state.x[i] += boundary[i];
      continue;
    }
    state.v[i] += dt * (-g_[i] / model_->node_mass[i] - damping * state.v[i]);
    state.x[i] += dt * state.v[i];
    sane = sane && dt * state.v[i].norm() < farthest_step;
  }
  MVS_MUST(sane, MVS_E_DIVERGED, "step",
           "the explicit solver blew up: its time step is too large for this valve");
  stats.kinetic = kinetic_energy(*model_, state.v);
  stats.contact_pairs = static_cast<uint32_t>(potential_.contact().stencils().size());
}

}  // namespace mvs
