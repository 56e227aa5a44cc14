// Time step at which symplectic Euler is stable on a valve.
#pragma once

#include "model/model.h"

namespace mvs::core {

// Returns a step in s, at most settings::defaults::explicit_dt. The step 2 / omega is stable;
// omega^2, the largest eigenvalue of M^-1 K, is at most twice the largest stiffness over the mass
// of a node (Gershgorin), with leaflets and chordae as stiff as in a closed valve. Contact, bending
// and damping are left out, a share of the step makes up for them.
double stable_explicit_step(const Model &model);

}  // namespace mvs::core
