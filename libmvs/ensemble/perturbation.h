// Small disturbances of a shape, smooth in space, that let nothing cross.
#pragma once

#include "ensemble/random.h"
#include "model/model.h"

namespace mvs::core {

struct Disturbance {
  double longest = 0;     // m, the farthest that a node is moved
  double wavelength = 0;  // m, the shortest wave
};

// Moves the free nodes of x; returns how far the farthest went. The displacement is a sum of plane
// waves in space, so that it does not depend on the mesh and sheets that lie together move
// together; it fades out towards prescribed nodes, and is shortened, node by node, where sheets
// would meet (physics/step_bounds.h).
double disturb(const Model &model, std::vector<Vec3> &x, const Disturbance &how, Random random);

}  // namespace mvs::core
