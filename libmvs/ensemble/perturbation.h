// Random perturbation of a shape by plane waves: smooth in space, bounded, without intersections.
#pragma once

#include "ensemble/random.h"
#include "model/model.h"

namespace mvs::core {

struct Disturbance {
  double longest = 0;     // m, the largest displacement of a node
  double wavelength = 0;  // m, the shortest wave
};

// Moves the free nodes of x and returns the largest displacement, m. The displacement is a sum of
// plane waves in space, so that it does not depend on the mesh and sheets in contact move together.
// It fades to zero towards prescribed nodes, and the step limiter shortens it node by node where
// sheets would meet (collision/step_limiter.h).
double disturb(const Model &model, std::vector<Vec3> &x, const Disturbance &how, Random random);

}  // namespace mvs::core
