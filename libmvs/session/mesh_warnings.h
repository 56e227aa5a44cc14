// Warnings about the mesh of a valve.
#pragma once

#include <vector>

#include "model/check.h"
#include "model/model.h"

namespace mvs::core {

// Returns what is doubtful in a valve that is otherwise valid, with nodes at x: an assumed anterior
// side, triangles that cross, triangles so low that the valve may not come to rest, edges shorter
// than the contact thickness.
std::vector<Fault> mesh_warnings(const Model &model, const std::vector<Vec3> &x);

}  // namespace mvs::core
