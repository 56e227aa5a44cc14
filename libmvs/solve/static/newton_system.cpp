// The linear system of a step: its matrix, the shift that makes it positive definite, its solution.
#include "solve/static/newton.h"

#include <algorithm>

#include "base/error.h"
#include "linalg/gmres.h"

namespace mvs::core {
namespace {

// Contact comes where the pattern has no room in most iterations; an order of elimination is good
// for a few such patterns.
constexpr uint32_t patterns_per_order = 6;

}  // namespace

void Newton::assemble(Curvature curvature) {
  curvature_ = curvature;
  if (total_energy_.hessian(x_, curvature, system_, stats_.work)) {
    system_.keep_order(++patterns_ % patterns_per_order != 0);
    const PhaseTimer timer(stats_.work, MVS_PHASE_ORDERING);
    factor_->analyse(system_.matrix);
  }
  diagonal_.resize(system_.node_of.size());
  for (size_t r = 0; r < diagonal_.size(); ++r) {
    diagonal_[r] = system_.matrix.value[system_.matrix.start[r]];
  }
}

// Factorises with the present shift, or the first larger one that makes the matrix positive
// definite.
void Newton::factorise() {
  const PhaseTimer timer(stats_.work, MVS_PHASE_FACTOR);
  added_ = std::max(shift_, least_shift);
  for (bool first = true;; first = false) {
    for (size_t r = 0; r < diagonal_.size(); ++r) {
      Mat3 &block = system_.matrix.value[system_.matrix.start[r]];
      block = diagonal_[r];
      block.diagonal().array() += added_ * shift_scale_[system_.node_of[r]];
      if (!hold_.empty()) block += hold_[r];
    }
    ++stats_.factorisations;
    if (factor_->factorise(system_.matrix)) return;
    if (first) ++stats_.shifted;
    added_ = shift_ = std::max(3 * added_, 0.05);
    MVS_MUST(added_ < 1e12, MVS_E_DIVERGED, "settle",
             "the stiffness matrix is not finite; check the materials");
  }
}

void Newton::solve_system(std::vector<Vec3> &rows) {
  factor_->solve(rows);
  stats_.work.linear_iterations += factor_->iterations();
}

// The step that the factorised system gives, in full_.
void Newton::solve(bool with_shift) {
  const PhaseTimer timer(stats_.work, MVS_PHASE_SOLVE);
  rows_.resize(system_.node_of.size());
  for (size_t r = 0; r < rows_.size(); ++r) rows_[r] = -g_[system_.node_of[r]];
  solve_system(rows_);
  if (curvature_ == Curvature::exact) include_skew(with_shift);
  full_.assign(x_.size(), Vec3::Zero());
  for (size_t r = 0; r < rows_.size(); ++r) full_[system_.node_of[r]] = rows_[r];
}

// Turns (H + shift D)^-1 b into the solution for the true derivative, H + S (+ shift D), S the skew
// part that the free edge adds.
void Newton::include_skew(bool with_shift) {
  const double removed = with_shift ? 0 : added_;
  auto apply = [&](const std::vector<Vec3> &v) {
    trial_.assign(x_.size(), Vec3::Zero());
    for (size_t r = 0; r < v.size(); ++r) trial_[system_.node_of[r]] = v[r];
    step_.assign(x_.size(), Vec3::Zero());
    total_energy_.add_skew(x_, trial_, step_);
    std::vector<Vec3> y(v.size());
    for (size_t r = 0; r < v.size(); ++r) {
      const uint32_t i = system_.node_of[r];
      y[r] = step_[i] - removed * shift_scale_[i] * v[r];
    }
    solve_system(y);
    for (size_t r = 0; r < v.size(); ++r) y[r] += v[r];
    return y;
  };
  gmres(apply, rows_, 30, 1e-3);
}

}  // namespace mvs::core
