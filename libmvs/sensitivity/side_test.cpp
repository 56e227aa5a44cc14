// Forces at both ends of a short step.
#include "sensitivity/side_test.h"

#include <algorithm>

#include "sensitivity/linear_response.h"
#include "sensitivity/settings.h"
#include "sensitivity/switch_problem.h"

namespace mvs::core {
namespace {

// The change of the forces on one side.
NodeField force_at(const Model &model, const State &state, EquilibriumTangent &tangent,
                   std::span<const ParameterStep> direction, const NodeField &motion, double h) {
  std::vector<Vec3> x = state.x;
  for (size_t i = 0; i < x.size(); ++i) x[i] += h * motion[i];
  std::vector<ParameterStep> steps(direction.begin(), direction.end());
  for (ParameterStep &step : steps) step.by *= h;
  NodeField e = tangent.gradient_at(x);
  add_change(model, steps, x, e);
  for (size_t i = 0; i < e.size(); ++i) e[i] = (e[i] - tangent.gradient()[i]) / h;
  return e;
}

// Errors of a motion at the distance h, m by the fastest node or chord.
struct SideErrors {
  double mean, half;  // of both sides; of their difference
};

SideErrors errors_at(const Model &model, const State &state, EquilibriumTangent &tangent,
                     std::span<const ParameterStep> steps, const NodeField &motion, double h) {
  NodeField above = force_at(model, state, tangent, steps, motion, h);
  NodeField below = force_at(model, state, tangent, steps, motion, -h);
  tangent.solve(above, false);
  tangent.solve(below, false);
  NodeField mean(above.size()), half(above.size());
  for (size_t i = 0; i < mean.size(); ++i) {
    mean[i] = 0.5 * (above[i] + below[i]);
    half[i] = 0.5 * (above[i] - below[i]);
  }
  return {fastest_of(mean), fastest_of(half)};
}

// To which errors are relative: the fastest node; where a chord that is slack moves nothing, a
// share of the change of its own length, as forces differ by rounding.
double scale_of(const NodeField &motion, double fastest) {
  return std::max(fastest_of(motion), settings::sensitivity::least_motion * fastest);
}

}  // namespace

double fastest_along(std::span<const ParameterStep> steps, const NodeField &motion) {
  double fastest = fastest_of(motion);
  for (const ParameterStep &step : steps) {
    if (step.parameter->kind == ParameterKind::chord_rest_length ||
        step.parameter->kind == ParameterKind::chord_site) {
      fastest = std::max(fastest, std::abs(step.by));
    }
  }
  return fastest;
}

bool holds_on_both_sides(const Model &model, const State &state, EquilibriumTangent &tangent,
                         std::span<const ParameterStep> steps, const NodeField &motion,
                         double slack) {
  namespace set = settings::sensitivity;
  const double fastest = fastest_along(steps, motion);
  if (fastest == 0) return true;
  const double scale = scale_of(motion, fastest);
  const auto at = [&](double distance) {
    return errors_at(model, state, tangent, steps, motion, distance / fastest);
  };
  const SideErrors errors = at(slack);
  if (errors.mean > set::mean_error * scale) return false;
  if (errors.half <= set::side_error * scale) return true;
  // no switch, but a strong curvature: its error falls with the distance
  return at(set::nearer * slack).half <= set::side_error * scale;
}

bool holds_on_one_side(const Model &model, const State &state, EquilibriumTangent &tangent,
                       std::span<const ParameterStep> steps, const SideMotion &moved,
                       const std::vector<Switch> &switches, double slack) {
  const double fastest = fastest_along(steps, moved.motion);
  if (fastest == 0) return true;
  const double h = slack / fastest;
  NodeField e = force_at(model, state, tangent, steps, moved.motion, h);
  // with the motion of these switches K dx + g_p = -sum t a, and they begin at their places
  for (size_t i = 0; i < switches.size(); ++i) {
    if (moved.forces[i] == 0) continue;
    const double force = extra_force(switches[i], h * moved.rates[i]) / h;
    for (const NodeVector &v : switches[i].gradient) {
      if (!model.topology.fixed[v.node]) e[v.node] -= (force - moved.forces[i]) * v.value;
    }
  }
  tangent.solve(e, false);
  return fastest_of(e) <= settings::sensitivity::side_error * scale_of(moved.motion, fastest);
}

}  // namespace mvs::core
