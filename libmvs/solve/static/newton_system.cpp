// Assembles, factorises and solves the linear system of a Newton iteration.
#include "solve/static/newton_system.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "linalg/gmres.h"
#include "solve/settings.h"

namespace mvs::core {

void OrderLifetime::begin_pattern() {
  if (!is_kept_) {
    patterns_ = 0;
    first_ = in_excess_ = 0;
  }
  is_kept_ = ++patterns_ < settings::newton::patterns_per_order;
}

void OrderLifetime::count(double products, double rows) {
  if (first_ == 0) first_ = products;
  in_excess_ += std::max(products - first_, 0.0);
  if (in_excess_ > settings::newton::products_per_order * rows) is_kept_ = false;
}

void NewtonSystem::set_scale(double pressure, double mean_area) {
  lambda_scale_.clear();
  for (const double a : model_->vertex_area) {
    lambda_scale_.push_back(pressure * std::sqrt(std::max(a, mean_area)));
  }
}

void NewtonSystem::assemble(Curvature curvature, Profile &profile) {
  curvature_ = curvature;
  if (total_energy_->hessian(*x_, curvature, assembler_, profile)) {
    order_.begin_pattern();
    assembler_.keep_order(order_.is_kept());
    is_analysed_ = false;
  }
  diagonal_.resize(assembler_.node_of.size());
  for (size_t r = 0; r < diagonal_.size(); ++r) {
    diagonal_[r] = assembler_.matrix.value[assembler_.matrix.start[r]];
  }
}

void NewtonSystem::assemble(Curvature curvature, const std::vector<Vec3> &boundary,
                            Profile &profile) {
  assembler_.boundary_step = &boundary;
  assemble(curvature, profile);
  assembler_.boundary_step = nullptr;
}

// Where only the stability is checked the matrix is never factorised here.
void NewtonSystem::analyse(Profile &profile) {
  if (is_analysed_) return;
  poll_();
  const PhaseTimer timer(profile, MVS_PHASE_ORDERING);
  factor_->analyse(assembler_.matrix);
  is_analysed_ = true;
}

// Counts a factorisation, which may make a new order worth its cost.
void NewtonSystem::count_factorisation(SolveStats &stats) {
  ++stats.factorisations;
  order_.count(factor_->products(), static_cast<double>(assembler_.node_of.size()));
  assembler_.keep_order(order_.is_kept());
}

void NewtonSystem::add_lambda(double lambda) {
  applied_lambda_ = std::max(lambda, settings::newton::min_lambda);
  for (size_t r = 0; r < diagonal_.size(); ++r) {
    Mat3 &block = assembler_.matrix.value[assembler_.matrix.start[r]];
    block = diagonal_[r];
    block.diagonal().array() += applied_lambda_ * lambda_scale_[assembler_.node_of[r]];
    if (!stiffening_.empty()) block += stiffening_[r];
  }
}

bool NewtonSystem::try_factorise(double lambda, SolveStats &stats) {
  analyse(stats.work);
  const PhaseTimer timer(stats.work, MVS_PHASE_FACTOR);
  add_lambda(lambda);
  poll_();
  count_factorisation(stats);
  return factor_->factorise_cheaply(assembler_.matrix);
}

// A matrix that cannot be factorised is mostly indefinite: double precision, which takes twice the
// time, is tried after a few larger lambdas only.
void NewtonSystem::factorise(double &lambda, SolveStats &stats) {
  if (try_factorise(lambda, stats)) return;
  ++stats.shifted;
  const PhaseTimer timer(stats.work, MVS_PHASE_FACTOR);
  for (uint32_t failed = 1;; ++failed) {
    lambda = std::max(settings::newton::failed_lambda_growth * applied_lambda_,
                      settings::newton::failed_lambda);
    MVS_MUST(lambda < settings::newton::max_failed_lambda, MVS_E_DIVERGED, "settle",
             "the stiffness matrix is not finite; check the materials");
    add_lambda(lambda);
    poll_();
    count_factorisation(stats);
    const bool cheaply = failed < settings::newton::cheap_factorisations;
    if (cheaply ? factor_->factorise_cheaply(assembler_.matrix)
                : factor_->factorise(assembler_.matrix)) {
      return;
    }
  }
}

const HessianAssembler &NewtonSystem::hessian() {
  for (size_t r = 0; r < diagonal_.size(); ++r) {
    assembler_.matrix.value[assembler_.matrix.start[r]] = diagonal_[r];
  }
  return assembler_;
}

void NewtonSystem::solve(const std::vector<Vec3> &g, bool with_lambda, std::vector<Vec3> &step,
                         SolveStats &stats) {
  const PhaseTimer timer(stats.work, MVS_PHASE_SOLVE);
  rows_.resize(assembler_.node_of.size());
  for (size_t r = 0; r < rows_.size(); ++r) rows_[r] = -g[assembler_.node_of[r]];
  if (curvature_ == Curvature::exact) {
    solve_exactly(with_lambda, stats);
  } else {
    solve_rows(rows_, stats);
  }
  step.assign(x_->size(), Vec3::Zero());
  for (size_t r = 0; r < rows_.size(); ++r) step[assembler_.node_of[r]] = rows_[r];
}

void NewtonSystem::carry(std::vector<Vec3> &step, SolveStats &stats) {
  rows_ = assembler_.boundary_force;
  solve_rows(rows_, stats);
  for (size_t r = 0; r < rows_.size(); ++r) step[assembler_.node_of[r]] = rows_[r];
}

void NewtonSystem::solve_rows(std::vector<Vec3> &rows, SolveStats &stats) {
  poll_();
  factor_->solve(rows);
  stats.work.linear_iterations += factor_->iterations();
}

// Solves the true linear system, (H + S (+ lambda D)) x = b, S the skew part at the free edge. A
// factor in single precision may be too inaccurate to precondition it: then one in double.
void NewtonSystem::solve_exactly(bool with_lambda, SolveStats &stats) {
  const double removed = with_lambda ? 0 : applied_lambda_;
  const std::vector<Vec3> b = rows_;
  const double error = solve_by_gmres(removed, stats);
  if (error <= settings::newton::gmres_tolerance || !factor_->sharpen()) return;
  rows_ = b;
  solve_by_gmres(removed, stats);
}

// Returns the relative residual, in the norm of the preconditioned system.
double NewtonSystem::solve_by_gmres(double removed_lambda, SolveStats &stats) {
  const auto precondition = [&](std::vector<Vec3> &v) {
    poll_();
    ++stats.work.linear_iterations;
    factor_->precondition(v);
  };
  const auto apply = [&](const std::vector<Vec3> &v) {
    direction_.assign(x_->size(), Vec3::Zero());
    for (size_t r = 0; r < v.size(); ++r) direction_[assembler_.node_of[r]] = v[r];
    skew_.assign(x_->size(), Vec3::Zero());
    total_energy_->add_skew(*x_, direction_, skew_);
    std::vector<Vec3> y(v.size());
    product_.multiply(assembler_.matrix, v, y);
    for (size_t r = 0; r < v.size(); ++r) {
      const uint32_t i = assembler_.node_of[r];
      y[r] += skew_[i] - removed_lambda * lambda_scale_[i] * v[r];
    }
    precondition(y);
    return y;
  };
  precondition(rows_);
  return gmres(apply, rows_, settings::newton::gmres_iterations, settings::newton::gmres_tolerance);
}

double NewtonSystem::quadratic_form(const std::vector<Vec3> &step) const {
  const BlockMatrix &m = assembler_.matrix;
  double sum = 0;
  for (uint32_t c = 0; c < m.size(); ++c) {
    const Vec3 &d = step[assembler_.node_of[c]];
    Vec3 below = Vec3::Zero();
    for (uint32_t k = m.start[c] + 1; k < m.start[c + 1]; ++k) {
      below += m.value[k].transpose() * step[assembler_.node_of[m.row[k]]];
    }
    sum += d.dot(diagonal_[c] * d + 2 * below);
  }
  return sum;
}

void NewtonSystem::stiffen(size_t row, const Vec3 &direction, double times) {
  stiffening_.resize(diagonal_.size(), Mat3::Zero());
  const double stiff = times * (diagonal_[row] + stiffening_[row]).trace() / 3;
  stiffening_[row] += stiff * direction * direction.transpose();
}

}  // namespace mvs::core
