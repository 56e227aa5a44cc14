// Fixture: a small valve whose boundary moves when it is loaded, and a clamped disc of soft tissue.
#pragma once

#include <mvs/sim.h>

#include "model/model.h"
#include "tests/model/small_valve.h"
#include "tests/solve/bench.h"

namespace mvs::core::test {

inline constexpr double systole = MVS_SYSTOLE_PA;

inline Valve moving_valve() {
  Valve valve = small_valve();
  valve.loaded = valve.rest;
  for (const uint32_t node : valve.annulus) {
    valve.loaded[node].x() *= 0.92;
    valve.loaded[node].z() -= 1e-3;
  }
  for (const Head &head : valve.heads) valve.loaded[head.node].z() += 2e-3;
  return valve;
}

inline Model soft_disc(uint32_t rings) {
  return clamped_disc(rings, 12e-3, [](Valve &) {});
}

}  // namespace mvs::core::test
