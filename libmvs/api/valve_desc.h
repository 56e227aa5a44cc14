// A valve as the caller describes it, made into the core's own.
#pragma once

#include <mvs/valve.h>

#include "model/model.h"

namespace mvs::core {

// What a description holds: the valve, and the positions to start from (empty: the rest shape).
struct Described {
  Valve valve;
  std::vector<Vec3> now;
};

// Throws MVS_E_ARGUMENT, _MEMORY or _VERSION where the description cannot be read; whether it is a
// valve is left to find_faults.
Described read_valve_desc(const mvs_valve_desc *given);

// Gives a leaflet the law, thickness and constants of a description; throws MVS_E_ARGUMENT where it
// says more than that.
void set_tissue(Leaflet &leaflet, const mvs_leaflet_desc &tissue);

// The state that a described valve starts from; throws MVS_E_ARGUMENT where positions are none.
State described_state(const Model &model, const std::vector<Vec3> &now);

}  // namespace mvs::core
