// Dynamic relaxation at its best: the settings of a grid that bring a valve to rest soonest.
#pragma once

#include "tests/bench/closing.h"
#include "tests/bench/relaxation/relaxation.h"

namespace bench {

inline const std::map<Damping, std::string> damping_names = {{Damping::viscous, "viscous"},
                                                             {Damping::kinetic, "kinetic"}};

struct Relaxed {
  RelaxationOptions taken;
  Closing closing;
  int tried = 0, came_to_rest = 0;  // settings
};

// Closes `of` with each setting of the grid. Where none comes to rest, the result is that with the
// smallest residual.
Relaxed close_relaxed(const Case &of, Damping damping);

// The settings that it took, and how many came to rest.
std::string words_of(const Relaxed &relaxed);

}  // namespace bench
