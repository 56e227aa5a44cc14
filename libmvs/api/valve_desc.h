// Converts the caller's description of a valve to a Valve and its node positions.
#pragma once

#include <mvs/valve.h>

#include "model/model.h"

namespace mvs::core {

// A valve, and its initial positions (empty: the rest shape).
struct Described {
  Valve valve;
  std::vector<Vec3> now;
};

// Throws MVS_E_ARGUMENT, _MEMORY or _VERSION if the description cannot be read. Does not check the
// valve: find_faults does.
Described read_valve_desc(const mvs_valve_desc *given);

// Sets law, thickness and constants of a leaflet; throws MVS_E_ARGUMENT if the description has
// other fields.
void set_tissue(Leaflet &leaflet, const mvs_leaflet_desc &tissue);

// Returns the initial state of a described valve; throws MVS_E_ARGUMENT if a position is not finite
// or too far from the rest shape.
State described_state(const Model &model, const std::vector<Vec3> &now);

}  // namespace mvs::core
