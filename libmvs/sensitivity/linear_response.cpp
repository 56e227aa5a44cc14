// Direct differentiation, one solution with K for each parameter; adjoint, one with its transpose
// for each quantity.
#include "sensitivity/linear_response.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "sensitivity/measure_differences.h"

namespace mvs::core {

double dot_of(const NodeField &a, const NodeField &b) {
  double sum = 0;
  for (size_t i = 0; i < a.size(); ++i) sum += a[i].dot(b[i]);
  return sum;
}

double fastest_of(const NodeField &field) {
  double square = 0;
  for (const Vec3 &v : field) square = std::max(square, v.squaredNorm());
  return std::sqrt(square);
}

namespace {

double sparse_dot(const NodeField &a, const std::vector<NodeVector> &b) {
  double sum = 0;
  for (const NodeVector &v : b) sum += a[v.node].dot(v.value);
  return sum;
}

}  // namespace

LinearResponse::LinearResponse(const SensitivityRequest &request,
                               std::vector<QuantityGradient> gradients, EquilibriumTangent &tangent)
    : request_(request), tangent_(tangent), gradients_(std::move(gradients)) {
  for (const Parameter &p : request.parameters) {
    loads_.push_back(parameter_load(request.model, request.state, p));
  }
  rows_.assign(gradients_.size() * parameters(), 0);
}

NodeField LinearResponse::motion_of(std::span<const ParameterStep> steps) {
  NodeField b(request_.model.node_count(), Vec3::Zero()), moved = b, pulled;
  bool moves = false;
  for (const ParameterStep &step : steps) {
    const ParameterLoad &load =
        loads_[static_cast<size_t>(step.parameter - request_.parameters.data())];
    for (const NodeVector &v : load.force) b[v.node] -= step.by * v.value;
    for (const NodeVector &v : load.motion) moved[v.node] += step.by * v.value;
    moves = moves || !load.motion.empty();
  }
  if (moves) {
    tangent_.multiply(moved, false, pulled);
    for (size_t i = 0; i < b.size(); ++i) b[i] -= pulled[i];
  }
  tangent_.solve(b, false);
  ++direct_solves_;
  for (size_t i = 0; i < b.size(); ++i) b[i] += moved[i];
  return b;
}

void LinearResponse::fill_rows(size_t p) {
  const auto &[model, state, quantities, parameters] = request_;
  const Parameter &parameter = parameters[p];
  const NodeField &motion = motions_[p];
  std::optional<MeasureDifferences> differences;
  for (size_t q = 0; q < gradients_.size(); ++q) {
    const QuantityGradient &g = gradients_[q];
    double &row = rows_[q * parameters.size() + p];
    if (g.by_differences) {
      if (!differences) differences.emplace(model, state, parameter, motion);
      row = differences->of(*quantities[q].measure);
    } else {
      row = dot_of(g.by_position, motion) + explicit_derivative(model, state.x, g, parameter);
    }
  }
}

void LinearResponse::solve_directly(size_t tests, const std::function<void()> &after_one) {
  tangent_.expect_solutions((1 + tests) * parameters());
  for (size_t p = 0; p < parameters(); ++p) {
    const ParameterStep step = {&request_.parameters[p], 1};
    motions_.push_back(motion_of({&step, 1}));
    fill_rows(p);
    after_one();
  }
}

void LinearResponse::solve_adjoint(const std::function<void()> &after_one) {
  const bool moves = std::any_of(loads_.begin(), loads_.end(),
                                 [](const ParameterLoad &l) { return !l.motion.empty(); });
  NodeField pulled;
  for (size_t q = 0; q < gradients_.size(); ++q) {
    const QuantityGradient &g = gradients_[q];
    NodeField lambda = g.by_position;
    tangent_.solve(lambda, true);
    ++adjoint_solves_;
    if (moves) tangent_.multiply(lambda, true, pulled);
    for (size_t p = 0; p < parameters(); ++p) {
      double &row = rows_[q * parameters() + p];
      row = explicit_derivative(request_.model, request_.state.x, g, request_.parameters[p]) -
            sparse_dot(lambda, loads_[p].force);
      if (moves) {
        row += sparse_dot(g.by_position, loads_[p].motion) - sparse_dot(pulled, loads_[p].motion);
      }
    }
    after_one();
  }
}

}  // namespace mvs::core
