// A call that changes a simulator: one at a time, exceptions as result codes.
#pragma once

#include "api/structs.h"
#include "session/simulator.h"

namespace mvs::core {

// Runs work(*sim). Throws MVS_E_STATE during another call on the same simulator.
template <typename Work>
mvs_result call_at_boundary(mvs_sim *sim, Work &&work) noexcept {
  return at_boundary([&] {
    const AtWork at_work(sim);
    if (sim->workers) sim->workers->begin_call();
    work(*sim);
  });
}

}  // namespace mvs::core
