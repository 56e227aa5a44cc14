// The founding paper's method at its best: the largest time step that closes a valve, and the
// damping that closes it soonest.
#pragma once

#include "tests/bench/closing.h"

namespace bench {

struct Founding {
  Case taken;  // the case with its dt and damping
  Closing closing;
};

// Closes `of` explicitly. A dt or damping of 0 is searched for: dt on a ladder of fourth roots of
// two until a closure fails, then the damping, doubled or halved as long as that pays.
Founding close_founding(Case of);

}  // namespace bench
