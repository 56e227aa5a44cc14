// What the host is told of a valve's mesh.
#pragma once

#include "api/simulator.h"

namespace mvs {

// Logs edges shorter than the contact thickness, which is no fault, and triangles so low that the
// valve may not come to rest.
void log_mesh(const mvs_sim &sim, const Model &model);

}  // namespace mvs
