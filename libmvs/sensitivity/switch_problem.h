// The one-sided problem at switches: in a direction of the parameters the rates u of the switches
// and the extra forces t along their gradients satisfy
//     u + S t = u0,   t_i = up_i u_i for u_i > 0,   t_i = down_i u_i for u_i < 0,
// u0 the rates of the tangent, S the flexibility: a linear complementarity problem, for symmetric S
// the optimality condition of a quadratic program over the switches (Pirnay, Lopez-Negrete &
// Biegler, Math. Prog. Comp. 4, 2012, equation 14). The factor of the tangent stays.
//
// Contact that begins has a stiffness that grows from zero: its t is the mean over a step along
// which the fastest switch would move by `travel` if no such contact pushed.
#pragma once

#include <vector>

#include "sensitivity/switches.h"

namespace mvs::core {

// Solves by an active set of the states of the switches: all that contradict change at once, later
// the first one alone (Murty, Math. Prog. 5, 1973, which ends if all principal minors of I + S K
// are positive); Newton's method around it for contact that begins. `flexibility` is row-major,
// `travel` in m. Returns t, or an empty list where no state was found to be consistent.
std::vector<double> extra_forces(const std::vector<Switch> &switches,
                                 const std::vector<double> &flexibility,
                                 const std::vector<double> &rates, double travel);

// The extra force along a switch after u has moved by `by`, m, from where it is now: N.
double extra_force(const Switch &s, double by);

}  // namespace mvs::core
