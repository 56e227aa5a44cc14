// Forces at both ends of a short step.
#include "sensitivity/side_test.h"

#include <algorithm>

#include "sensitivity/settings.h"

namespace mvs::core {
namespace {

double fastest_of(const NodeField &field) {
  double square = 0;
  for (const Vec3 &v : field) square = std::max(square, v.squaredNorm());
  return std::sqrt(square);
}

// The error of the motion on one side.
NodeField error_at(const Model &model, const State &state, EquilibriumTangent &tangent,
                   std::span<const ParameterStep> direction, const NodeField &motion, double h) {
  std::vector<Vec3> x = state.x;
  for (size_t i = 0; i < x.size(); ++i) x[i] += h * motion[i];
  std::vector<ParameterStep> steps(direction.begin(), direction.end());
  for (ParameterStep &step : steps) step.by *= h;
  NodeField e = tangent.gradient_at(x);
  add_change(model, steps, x, e);
  for (size_t i = 0; i < e.size(); ++i) e[i] = (e[i] - tangent.gradient()[i]) / h;
  tangent.solve(e, false);
  return e;
}

}  // namespace

bool holds_on_both_sides(const Model &model, const State &state, EquilibriumTangent &tangent,
                         std::span<const ParameterStep> steps, const NodeField &motion,
                         double slack) {
  namespace set = settings::sensitivity;
  double fastest = fastest_of(motion);
  for (const ParameterStep &step : steps) {
    // a chord may become taut by its own length alone
    if (step.parameter->kind == ParameterKind::chord_rest_length) {
      fastest = std::max(fastest, std::abs(step.by));
    }
  }
  if (fastest == 0) return true;
  const double h = slack / fastest;
  const NodeField above = error_at(model, state, tangent, steps, motion, h);
  const NodeField below = error_at(model, state, tangent, steps, motion, -h);
  NodeField mean(above.size()), half(above.size());
  for (size_t i = 0; i < mean.size(); ++i) {
    mean[i] = 0.5 * (above[i] + below[i]);
    half[i] = 0.5 * (above[i] - below[i]);
  }
  return fastest_of(mean) <= set::mean_error * fastest_of(motion) &&
         fastest_of(half) <= set::side_error * fastest_of(motion);
}

}  // namespace mvs::core
