// Test of a derivative on both sides: whether the valve follows it there.
//
// For a step h along the parameters and the positions that they move, the out-of-balance force
// e = (g(x + h dx, p + h) - g(x, p)) / h would be 0 if the forces were linear; K^-1 e is the error
// of dx on that side. At a smooth point both sides have opposite errors of order h; where contact,
// a chord or the law of a spring switches within h, they do not. So the test needs no list of what
// may switch, and does not take the mean of two sides for a derivative, as a central difference
// would. Errors are relative to the fastest node or, where a slack chord moves nothing, to a small
// share of the change of its own length.
#pragma once

#include <span>

#include "sensitivity/switches.h"

namespace mvs::core {

// The displacement of the fastest node, or the change of a chord's own length or site, by which it
// may become taut alone.
double fastest_along(std::span<const ParameterStep> steps, const NodeField &motion);

// `motion` is dx for the change `steps` of the parameters. Takes two solutions, four
// where only the difference of both sides is too large.
bool holds_on_both_sides(const Model &model, const State &state, EquilibriumTangent &tangent,
                         std::span<const ParameterStep> steps, const NodeField &motion,
                         double slack);

// A motion on one side of switches, with their rates and extra forces.
struct SideMotion {
  NodeField motion;
  std::vector<double> rates, forces;
};

// The same test on one side alone: `slack` has its sign. What is left after the forces that the
// switches have at that distance was overlooked. Takes one solution.
bool holds_on_one_side(const Model &model, const State &state, EquilibriumTangent &tangent,
                       std::span<const ParameterStep> steps, const SideMotion &moved,
                       const std::vector<Switch> &switches, double slack);

}  // namespace mvs::core
