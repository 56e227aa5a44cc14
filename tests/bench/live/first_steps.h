// The cost of the first step of a simulator.
#pragma once

#include <mvs/sim.h>

#include <functional>
#include <string>

namespace bench {

// Prints medians over new simulators that begin with this valve, closed, whose load falls by a
// tenth: the first step, the second one, mvs_prepare_step, and the first step after that. now: s.
void tell_first_steps(const std::string &scene, const mvs_parametric_desc &valve,
                      const std::function<double()> &now);

}  // namespace bench
