// Directional derivatives with their test, and the two fallbacks.
#include "tests/bench/fit/exact_jacobian.h"

#include "base/error.h"
#include "patient/fit/linear_closure.h"
#include "sensitivity/linear_response.h"
#include "sensitivity/sensitivity.h"
#include "sensitivity/side_test.h"

using namespace mvs::core;

namespace bench {
namespace {

constexpr double tested_distance = 1e-7;  // m: the default of mvs_sensitivity_options

struct Motion {
  NodeField dx;
  bool holds = true;
};

// Motions by the logarithm of the lengths of each group.
std::vector<Motion> motions_of(const ClosedValve &closed, const std::vector<ChordGroup> &groups,
                               bool tested) {
  const Model &model = *closed.model;
  std::vector<Parameter> lengths(model.valve.chords.size());
  for (uint32_t c = 0; c < lengths.size(); ++c) {
    lengths[c].kind = ParameterKind::chord_rest_length;
    lengths[c].index = c;
  }
  const State clear = with_slack_branches(model, closed.state, tested_distance);
  EquilibriumTangent tangent(model, clear);
  must_be_stable(model, clear, tangent);
  // a test takes two solutions
  tangent.expect_solutions((tested ? 3 : 1) * groups.size());
  const std::vector<Quantity> no_quantities;
  const SensitivityRequest request = {model, clear, no_quantities, lengths};
  LinearResponse response(request, {}, tangent);
  std::vector<Motion> found;
  for (const ChordGroup &group : groups) {
    std::vector<ParameterStep> steps;
    for (const uint32_t c : group.chords) {
      steps.push_back({&lengths[c], model.valve.chords[c].rest_length});
    }
    Motion &one = found.emplace_back();
    one.dx = response.motion_of(steps);
    if (tested) {
      one.holds = holds_on_both_sides(model, clear, tangent, steps, one.dx, tested_distance);
    }
  }
  return found;
}

}  // namespace

ClosedJacobian exact_jacobian(Solver &solver, bool tested) {
  return [tested, by_differences = jacobian_by_differences(solver),
          linear = jacobian_by_linearisation()](const ClosedValve &closed,
                                                const std::vector<ChordGroup> &groups,
                                                const std::vector<SurfaceMatch> &matches) {
    std::vector<std::vector<double>> jacobian;
    try {
      const std::vector<Motion> motions = motions_of(closed, groups, tested);
      for (size_t g = 0; g < groups.size(); ++g) {
        if (!motions[g].holds) {
          jacobian.push_back(by_differences(closed, {groups[g]}, matches).front());
          continue;
        }
        std::vector<double> &column = jacobian.emplace_back();
        for (const SurfaceMatch &m : matches) column.push_back(m.derivative(motions[g].dx));
      }
    } catch (const Error &error) {
      if (error.code != MVS_E_STATE && error.code != MVS_E_DIVERGED) throw;
      return linear(closed, groups, matches);
    }
    return jacobian;
  };
}

}  // namespace bench
