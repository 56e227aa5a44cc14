// What the host is told of a valve's mesh.
#pragma once

#include "session/simulator.h"

namespace mvs::core {

// Logs edges shorter than the contact thickness, which is no fault, triangles so low that the valve
// may not come to rest, and which side is taken for the anterior one where no name tells.
void log_mesh(const mvs_sim &sim, const Model &model);

}  // namespace mvs::core
