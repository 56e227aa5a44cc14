// A planar cut through the leaflets.
#pragma once

#include <vector>

#include "model/model.h"

namespace mvs::core {

// The cut as pairs of points. Nodes on the plane count as in front of it, so that a cut along mesh
// edges appears once; the two triangles at an edge give the same bits for its point.
std::vector<Vec3> cut(const Model &model, const std::vector<Vec3> &x, const Vec3 &point,
                      const Vec3 &normal);

}  // namespace mvs::core
