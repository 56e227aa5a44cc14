// First derivatives at an equilibrium: the adjoint or direct solutions, without one-sided values
// and tests.
#pragma once

#include <functional>
#include <span>

#include "sensitivity/quantities.h"

namespace mvs::core {

// The quantities to differentiate, and the equilibrium.
struct SensitivityRequest {
  const Model &model;
  const State &state;
  const std::vector<Quantity> &quantities;
  const std::vector<Parameter> &parameters;
};

class LinearResponse {
 public:
  // Keeps references to the request and the tangent. `gradients`: of the quantities, then of
  // anything else that depends on positions.
  LinearResponse(const SensitivityRequest &request, std::vector<QuantityGradient> gradients,
                 EquilibriumTangent &tangent);

  // One solution for each parameter; `tests` more are expected for each. `after_one` is called
  // after each solution.
  void solve_directly(size_t tests, const std::function<void()> &after_one);
  // One solution for each gradient; none of them may be by differences.
  void solve_adjoint(const std::function<void()> &after_one);
  // dx for a change of parameters of the request, by one direct solution.
  NodeField motion_of(std::span<const ParameterStep> steps);

  size_t parameters() const { return request_.parameters.size(); }
  const QuantityGradient &gradient(size_t q) const { return gradients_[q]; }
  double row(size_t q, size_t p) const { return rows_[q * parameters() + p]; }
  const std::vector<double> &rows() const { return rows_; }
  const NodeField &motion(size_t p) const { return motions_[p]; }  // if solved directly
  bool has_motions() const { return !motions_.empty(); }
  uint32_t adjoint_solves() const { return adjoint_solves_; }
  uint32_t direct_solves() const { return direct_solves_; }

 private:
  void fill_rows(size_t p);

  const SensitivityRequest &request_;
  EquilibriumTangent &tangent_;
  std::vector<QuantityGradient> gradients_;
  std::vector<ParameterLoad> loads_;
  std::vector<NodeField> motions_;
  std::vector<double> rows_;  // a row a gradient
  uint32_t adjoint_solves_ = 0, direct_solves_ = 0;
};

double dot_of(const NodeField &a, const NodeField &b);
// The largest of its vectors.
double fastest_of(const NodeField &field);

}  // namespace mvs::core
