// An example of each operation, for the golden scenes that operate.
#pragma once

#include <functional>
#include <vector>

#include "tests/golden/sim.h"

namespace golden {

// One operation on the closed valve: the bits before and after settling.
struct OpCase {
  const char *name;
  std::function<void(const Sim &)> apply;
};

std::vector<OpCase> op_cases();

}  // namespace golden
