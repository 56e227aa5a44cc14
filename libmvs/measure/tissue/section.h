// Intersection of the leaflets with a plane.
#pragma once

#include <vector>

#include "model/model.h"

namespace mvs::core {

// Returns the section as pairs of points. Nodes on the plane count as in front of it, so that a
// section along mesh edges appears once; both triangles at an edge give the same bits for its
// point.
std::vector<Vec3> plane_section(const Model &model, const std::vector<Vec3> &x, const Vec3 &point,
                                const Vec3 &normal);

}  // namespace mvs::core
