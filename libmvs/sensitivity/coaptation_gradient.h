// Gradient of the coaptation area with respect to positions: the weight with which each sample
// faces tissue (measure/coaptation/facing_weight.h), differentiated by dual numbers where it lies
// between 0 and 1. Exact, except where another triangle becomes the one that a sample faces best.
#pragma once

#include "sensitivity/tangent.h"

namespace mvs::core {

// Adds the gradient to g, m, and returns the area, m2.
double coaptation_area_gradient(const Model &model, const std::vector<Vec3> &x, NodeField &g);

}  // namespace mvs::core
