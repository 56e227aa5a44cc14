// Assembly and factor at the equilibrium; refinement around preconditioned GMRES.
#include "sensitivity/tangent.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "base/error.h"
#include "linalg/cholesky.h"
#include "linalg/extreme_eigenvalue.h"
#include "linalg/gmres.h"
#include "sensitivity/settings.h"
#include "solve/nodes.h"

namespace mvs::core {

namespace set = settings::sensitivity;

EquilibriumTangent::EquilibriumTangent(const Model &model, const State &state)
    : model_(&model), state_(&state), total_energy_(model), factor_(make_row_solver()) {
  const NodeField &x = state.x;
  total_energy_.use_verlet_list(false);
  total_energy_.set_pressure(state.load.pressure);
  total_energy_.set_tools(state.tools);
  const double slack = set::broad_phase_slack * model.valve.contact_thickness;
  total_energy_.prepare(x, x, slack, profile_);
  total_energy_.gradient(x, gradient_, profile_);
  residual_ = largest_free(model, gradient_);
  MVS_MUST(std::isfinite(residual_), MVS_E_DIVERGED, "sensitivity",
           "the forces of the snapshot are not finite: settle the valve first");
  free_.place = &x;
  total_energy_.hessian(x, Curvature::exact, free_, profile_);
  fix_loose_rows();
  factorise();
  find_edge();
}

// Branch points whose chordae are all slack have no stiffness: they get one, and do not move.
void EquilibriumTangent::fix_loose_rows() {
  BlockMatrix &m = free_.matrix;
  is_loose_.assign(m.size(), 1);
  for (uint32_t c = 0; c < m.size(); ++c) {
    for (uint32_t k = m.start[c]; k < m.start[c + 1]; ++k) {
      if (!m.value[k].isZero(0)) is_loose_[c] = is_loose_[m.row[k]] = 0;
    }
  }
  for (uint32_t c = 0; c < m.size(); ++c) {
    if (is_loose_[c]) m.value[m.start[c]] = Mat3::Identity();
  }
}

// Where Ks is indefinite, and the equilibrium stable by N alone, the factor is of Ks plus a shift.
void EquilibriumTangent::factorise() {
  factor_->analyse(free_.matrix);
  if (factor_->factorise(free_.matrix)) return;
  BlockMatrix shifted = free_.matrix;
  shift_ = set::first_shift;
  while (true) {
    MVS_MUST(shift_ < set::most_shift, MVS_E_DIVERGED, "sensitivity",
             "the stiffness matrix is not finite; check the materials");
    for (uint32_t c = 0; c < shifted.size(); ++c) {
      Mat3 &diagonal = shifted.value[shifted.start[c]];
      diagonal = free_.matrix.value[free_.matrix.start[c]];
      diagonal.diagonal().array() += shift_;
    }
    if (factor_->factorise(shifted)) return;
    shift_ *= set::shift_growth;
  }
}

// The rows that N couples: those of the free edges.
void EquilibriumTangent::find_edge() {
  std::vector<uint8_t> is_edge(free_.node_of.size(), 0);
  for (const std::vector<uint32_t> &loop : model_->topology.free_edges) {
    for (const uint32_t node : loop) {
      if (free_.row_of[node] != none) is_edge[free_.row_of[node]] = 1;
    }
  }
  for (uint32_t r = 0; r < is_edge.size(); ++r) {
    if (is_edge[r]) edge_.push_back(r);
  }
  factor_->choose_rows(edge_);
}

// y = K v by rows of the free nodes.
void EquilibriumTangent::apply(const NodeField &rows, bool transposed, NodeField &y) {
  product_.multiply(free_.matrix, rows, y);
  direction_.assign(model_->node_count(), Vec3::Zero());
  for (size_t r = 0; r < rows.size(); ++r) direction_[free_.node_of[r]] = rows[r];
  skew_.assign(model_->node_count(), Vec3::Zero());
  total_energy_.add_skew(state_->x, direction_, skew_);
  const double sign = transposed ? -1 : 1;
  for (size_t r = 0; r < rows.size(); ++r) y[r] += sign * skew_[free_.node_of[r]];
}

// With Ks = L L^T, E the rows of the free edge and N = E n E^T: K y = b has the solution
// y = Ks^-1 (b - E n y_E), y_E from (I + E^T Ks^-1 E n) y_E = E^T Ks^-1 b.
void EquilibriumTangent::expect_solutions(size_t count) {
  if (dense_ || shift_ != 0 || count < set::many_solutions) return;
  const size_t nodes = model_->node_count();
  NodeField unit(nodes, Vec3::Zero()), column(nodes);
  const size_t n = 3 * edge_.size();
  if (n == 0 || n > set::most_dense_rows || n > 6 * count) return;
  std::vector<double> matrix(n * n, 0);
  for (size_t c = 0; c < n; ++c) {
    unit[free_.node_of[edge_[c / 3]]][static_cast<int>(c % 3)] = 1;
    std::fill(column.begin(), column.end(), Vec3::Zero());
    total_energy_.add_skew(state_->x, unit, column);
    unit[free_.node_of[edge_[c / 3]]].setZero();
    NodeField rows(free_.node_of.size());
    for (size_t r = 0; r < rows.size(); ++r) rows[r] = column[free_.node_of[r]];
    factor_->solve(rows);
    for (size_t i = 0; i < n; ++i) {
      matrix[i * n + c] = rows[edge_[i / 3]][static_cast<int>(i % 3)] + (i == c ? 1.0 : 0.0);
    }
  }
  dense_ = std::make_unique<DenseFactor>(n, std::move(matrix));
  if (!dense_->is_regular()) dense_.reset();
}

void EquilibriumTangent::eliminate_skew(NodeField &r) {
  NodeField y = r;
  factor_->solve(y);
  std::vector<double> edge;
  for (const uint32_t row : edge_) edge.insert(edge.end(), y[row].data(), y[row].data() + 3);
  dense_->solve(edge);
  direction_.assign(model_->node_count(), Vec3::Zero());
  for (size_t k = 0; k < edge_.size(); ++k) {
    direction_[free_.node_of[edge_[k]]] = Vec3(edge[3 * k], edge[3 * k + 1], edge[3 * k + 2]);
  }
  skew_.assign(model_->node_count(), Vec3::Zero());
  total_energy_.add_skew(state_->x, direction_, skew_);
  for (size_t k = 0; k < r.size(); ++k) r[k] -= skew_[free_.node_of[k]];
  factor_->solve(r);
}

// GMRES in the rows of the free edge alone, which N has no other of: with c = Ks^-1 r the edge of
// the solution is y_E = c_E - (Ks^-1 N y)_E, and the solution Ks^-1 (r - N y).
void EquilibriumTangent::iterate_on_edge(bool transposed, double tolerance, NodeField &r) {
  NodeField whole = r, y;
  factor_->solve(whole);
  for (const uint32_t row : edge_) y.push_back(whole[row]);
  const double size = std::sqrt(dot(y, y));
  if (size == 0) return r.swap(whole);
  const auto skew = [&](const NodeField &v) {
    direction_.assign(model_->node_count(), Vec3::Zero());
    for (size_t k = 0; k < edge_.size(); ++k) direction_[free_.node_of[edge_[k]]] = v[k];
    skew_.assign(model_->node_count(), Vec3::Zero());
    total_energy_.add_skew(state_->x, direction_, skew_);
    NodeField rows;
    const double sign = transposed ? -1 : 1;
    for (const uint32_t row : edge_) rows.push_back(sign * skew_[free_.node_of[row]]);
    return rows;
  };
  const auto preconditioned = [&](const NodeField &v) {
    NodeField w = skew(v);
    factor_->solve_rows(w);
    for (size_t k = 0; k < w.size(); ++k) w[k] += v[k];
    return w;
  };
  gmres(preconditioned, y, set::gmres_iterations, tolerance * std::sqrt(dot(whole, whole)) / size);
  const NodeField moved = skew(y);
  for (size_t k = 0; k < edge_.size(); ++k) r[edge_[k]] -= moved[k];
  factor_->solve(r);
}

// Solves for a residual in place, to `tolerance`.
void EquilibriumTangent::approximate(bool transposed, double tolerance, NodeField &r) {
  if (dense_ && !transposed) return eliminate_skew(r);
  if (shift_ == 0) return iterate_on_edge(transposed, tolerance, r);
  factor_->solve(r);
  const auto preconditioned = [&](const NodeField &v) {
    NodeField y(v.size());
    apply(v, transposed, y);
    factor_->solve(y);
    return y;
  };
  gmres(preconditioned, r, set::gmres_iterations, tolerance);
}

// One round of refinement: x += a solution to `tolerance` for the residual. Returns |b - K x| /
// |b|.
double EquilibriumTangent::refine(const NodeField &b, bool transposed, double tolerance,
                                  NodeField &x) {
  NodeField r = residuals_;
  approximate(transposed, tolerance, r);
  for (size_t k = 0; k < x.size(); ++k) x[k] += r[k];
  residuals_.resize(x.size());
  apply(x, transposed, residuals_);
  for (size_t k = 0; k < x.size(); ++k) residuals_[k] = b[k] - residuals_[k];
  return std::sqrt(dot(residuals_, residuals_) / dot(b, b));
}

void EquilibriumTangent::solve(NodeField &b, bool transposed) {
  NodeField rows(free_.node_of.size());
  for (size_t r = 0; r < rows.size(); ++r) {
    rows[r] = is_loose_[r] ? Vec3(Vec3::Zero()) : b[free_.node_of[r]];
  }
  std::fill(b.begin(), b.end(), Vec3::Zero());
  if (dot(rows, rows) == 0) return;
  NodeField x(rows.size(), Vec3::Zero()), best = x;
  residuals_ = rows;
  double error = 1;
  for (int round = 0; round < set::refinements; ++round) {
    // a later round only has to reduce the error that is left to that of the solution
    const double left = set::refined_share * set::solve_tolerance / error;
    const double now = refine(rows, transposed, std::max(left, set::gmres_tolerance), x);
    if (!(now < error)) break;  // rounding
    error = now;
    best = x;
    if (error < set::solve_tolerance) break;
  }
  MVS_MUST(
      error < set::solve_limit, MVS_E_DIVERGED, "sensitivity",
      "the linear system of the derivatives is singular to rounding (residual %.1e): the valve "
      "is about to snap; settle it under a slightly different load",
      error);
  linear_error_ = std::max(linear_error_, error);
  for (size_t r = 0; r < rows.size(); ++r) b[free_.node_of[r]] = best[r];
}

void EquilibriumTangent::multiply(const NodeField &v, bool transposed, NodeField &y) {
  const NodeField &x = state_->x;
  if (all_.row_of.empty()) {
    std::vector<uint32_t> nodes(model_->node_count());
    std::iota(nodes.begin(), nodes.end(), 0u);
    all_.set_order(*model_, nodes);
    total_energy_.gradient(x, trial_, profile_);  // contact is measured here again
    total_energy_.set_pattern(all_);
    total_energy_.hessian(x, Curvature::exact, all_, profile_);
  }
  y.resize(v.size());
  product_.multiply(all_.matrix, v, y);
  skew_.assign(v.size(), Vec3::Zero());
  total_energy_.add_skew(x, v, skew_);
  const double sign = transposed ? -1 : 1;
  for (size_t i = 0; i < v.size(); ++i) y[i] += sign * skew_[i];
}

const NodeField &EquilibriumTangent::gradient_at(const NodeField &x) {
  const double slack = set::broad_phase_slack * model_->valve.contact_thickness;
  if (!total_energy_.prepared_for(x)) total_energy_.prepare(x, x, slack, profile_);
  total_energy_.gradient(x, trial_, profile_);
  return trial_;
}

// The margin of the leaflets, with branch points in equilibrium: the inverse of the part of Ks^-1
// of the leaflets is the Schur complement. A branch point between chordae that are hardly taut is
// soft, and says nothing about folds.
double EquilibriumTangent::smallest_stiffness() {
  const auto is_left_out = [&](size_t r) {
    return is_loose_[r] || model_->topology.node_kind[free_.node_of[r]] == NodeKind::branch;
  };
  const LinearMap invert = [&](const BlockVector &v, BlockVector &y) {
    y = v;
    factor_->solve(y);
    for (size_t r = 0; r < y.size(); ++r) {
      if (is_left_out(r)) y[r].setZero();
    }
  };
  // the same vector on every machine, with a share of every mode (Knuth, MMIX)
  BlockVector start(is_loose_.size(), Vec3::Zero());
  uint64_t seed = 1;
  for (size_t r = 0; r < start.size(); ++r) {
    for (int k = 0; k < 3; ++k) {
      seed = 6364136223846793005u * seed + 1442695040888963407u;
      if (!is_left_out(r)) start[r][k] = static_cast<double>(seed >> 11) * 0x1p-53 - 0.5;
    }
  }
  std::vector<BlockVector> basis;
  return smallest_eigenvalue(invert, start, {set::eigenvalue_error, set::eigenvalue_iterations},
                             basis)
             .real -
         shift_;
}

}  // namespace mvs::core
