// The cost of one search for pairs.
#pragma once

#include <vector>

#include "collision/broad_phase.h"
#include "tests/bench/clock.h"

namespace bench {

// The CPU seconds of a search for pairs as in mvs_settle: over the hierarchy, after every node has
// moved. From the place of the search before, all pairs would be skipped. `pairs` holds at x
// afterwards.
inline double time_of_search(int rounds, const std::vector<mvs::core::Vec3> &x, double slack,
                             mvs::core::BroadPhase &pairs) {
  std::vector<mvs::core::Vec3> beside = x;
  for (mvs::core::Vec3 &p : beside) p += mvs::core::Vec3::Constant(0.1 * slack);
  pairs.use_verlet_list(false);
  const double two = fastest(rounds, [&] {
    pairs.build(beside, beside, slack);
    pairs.build(x, x, slack);
  });
  return two / 2;
}

}  // namespace bench
