// Derivatives of a closed valve by rest lengths of chordae, from the room `sensitivity`, for the
// fit of the import.
#pragma once

#include "patient/fit/fit_to_closed.h"

namespace bench {

// One solution with the exact, undamped tangent for each group. If `tested`, groups whose
// derivative does not hold on both sides are differenced by a closure that starts from the closed
// valve. Where the equilibrium has no derivatives, being unstable or not at rest, all are by
// jacobian_by_linearisation().
mvs::core::ClosedJacobian exact_jacobian(mvs::core::Solver &solver, bool tested);

}  // namespace bench
