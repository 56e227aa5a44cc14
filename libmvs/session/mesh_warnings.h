// Warnings about the mesh of a valve.
#pragma once

#include <vector>

#include "model/checks/check.h"
#include "model/model.h"

namespace mvs::core {

// Returns the warnings about a valid valve with nodes at x: triangles that cross, tissue that
// touches itself at rest, edges shorter than the contact thickness, triangles so low that the valve
// may not come to rest, an assumed anterior side, chordae that end at the annulus.
std::vector<Fault> mesh_warnings(const Model &model, const std::vector<Vec3> &x);

}  // namespace mvs::core
