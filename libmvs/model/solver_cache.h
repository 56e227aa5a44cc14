// Opaque data of the solver that belongs to a state. It is an input of the next step, so it is
// saved, hashed and restored with the state; only libmvs/solve reads and writes its contents.
#pragma once

#include "base/cow_vector.h"

namespace mvs::core {

struct SolverCache {
  uint32_t version = 0;    // of the layout of `data`; 0 where the cache is empty
  uint64_t counter = 0;    // changes every step, while many steps share one buffer of `data`
  CowVector<double> data;  // finite numbers

  bool empty() const { return data.empty(); }
  bool operator==(const SolverCache &) const = default;
};

}  // namespace mvs::core
