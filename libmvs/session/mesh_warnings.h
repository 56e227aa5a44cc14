// Warnings about the mesh of a valve.
#pragma once

#include "session/simulator.h"

namespace mvs::core {

// Logs the number of edges shorter than the contact thickness (information), triangles so low that
// the valve may not come to rest, and the assumed anterior side if no leaflet is named A.
void log_mesh(const mvs_sim &sim, const Model &model);

}  // namespace mvs::core
