// Stretch and stress of the leaflets.
#pragma once

#include <vector>

#include "model/model.h"

namespace mvs::core {

// Shares of the tissue by rest area: half of it, 95 % and 99 % have at most this value.
struct Percentiles {
  double p50 = 0, p95 = 0, p99 = 0;
};

// Principal stretches and Cauchy stresses per triangle, larger first.
struct Strain {
  std::vector<std::array<double, 2>> stretch, stress;
  double max_strain = 0, max_stress = 0, leaflet_area = 0;
  Percentiles strain_percentiles, stress_percentiles;  // of strain and stress, at least 0
};
Strain measure_strain(const Model &model, const std::vector<Vec3> &x);

}  // namespace mvs::core
