// One triangle of the leaflets in its own plane: sides and Cauchy stress.
#pragma once

#include <vector>

#include "model/membrane.h"

namespace mvs::core {

// Side k from corner k to k + 1, in a basis of the triangle's plane whose first axis is side 0.
using Sides = Eigen::Matrix<double, 2, 3>;
Sides sides_in_plane(const std::vector<Vec3> &x, const Tri &triangle);

// The map from the rest triangle, in its fibre frame, to the present one in the basis of its sides:
// the deformation gradient.
Mat2 deformation_gradient(const Valve &valve, size_t t, const Sides &now);

// Cauchy stress of triangle t in the basis of its present sides, Pa: that of its membrane, or the
// virial of the springs along its sides.
Mat2 cauchy_stress(const Valve &valve, size_t t, const Sides &rest, const Sides &now);

}  // namespace mvs::core
