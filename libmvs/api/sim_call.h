// A call that changes a simulator: one at a time, its failures as result codes.
#pragma once

#include "api/structs.h"
#include "session/simulator.h"

namespace mvs::core {

// Runs work(*sim) as the one call at work on a simulator.
template <typename Work>
mvs_result call_at_boundary(mvs_sim *sim, Work &&work) noexcept {
  return at_boundary([&] {
    const AtWork at_work(sim);
    work(*sim);
  });
}

}  // namespace mvs::core
