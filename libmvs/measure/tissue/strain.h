// Stretch and stress of the leaflets.
#pragma once

#include <vector>

#include "model/model.h"

namespace mvs::core {

// Principal stretches and Cauchy stresses per triangle, larger first.
struct Strain {
  std::vector<std::array<double, 2>> stretch, stress;
  double max_strain = 0, max_stress = 0, leaflet_area = 0;
};
Strain measure_strain(const Model &model, const std::vector<Vec3> &x);

}  // namespace mvs::core
