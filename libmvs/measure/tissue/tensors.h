// Strain and stress of the leaflets as tensors in the fibre frame, per triangle and per node.
#pragma once

#include <vector>

#include "model/model.h"

namespace mvs::core {

// Rows are the components along the fibre (circumferential), across it (radial) and in shear.
struct Tensors {
  std::vector<Vec3> strain;     // per triangle: Green-Lagrange, (C - I) / 2
  std::vector<Vec3> stress;     // per triangle, Pa: Cauchy, turned back by the rotation of F
  std::vector<Vec3> direction;  // per triangle: present unit direction of the largest stretch
  std::vector<Vec3> node_strain, node_stress;  // means of the triangles at a node by rest area
};
Tensors measure_tensors(const Model &model, const std::vector<Vec3> &x);

}  // namespace mvs::core
