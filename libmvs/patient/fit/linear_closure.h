// Derivatives of a closed valve by rest lengths of chordae, by the implicit function theorem.
#pragma once

#include "patient/fit/fit_to_closed.h"

namespace mvs::core {

// H dx = -dg/dL at the equilibrium of the closed valve: one factorisation of the tangent for all
// groups, one solution for each. Modes that are softer than a thousandth of the stiffness of the
// load are damped, as their displacements are beyond the linear range. Contact and slack chordae
// are taken as they are at the equilibrium: chordae that hang slack have no derivative. The damping
// pays: with the exact derivatives of the room `sensitivity` fits took as long and ended a little
// farther from their surfaces (tests/bench/fit/fit_jacobian.cpp).
ClosedJacobian jacobian_by_linearisation();

// Differences of closures that start from the closed valve; for checks.
ClosedJacobian jacobian_by_differences(Solver &solver);

}  // namespace mvs::core
