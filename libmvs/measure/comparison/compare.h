// Distances between two leaflet surfaces.
#pragma once

#include <vector>

#include "model/model.h"

namespace mvs::core {

struct Comparison {
  bool same_mesh = false;
  double node_rms = 0, node_max = 0, surface_rms = 0, surface_max = 0;
  double node_rms_registered = 0, node_max_registered = 0, surface_rms_registered = 0,
         surface_max_registered = 0;
  std::array<double, 12> registration{};  // rows of [R | t]
};
Comparison compare_shapes(const Model &a, const std::vector<Vec3> &xa, const Model &b,
                          const std::vector<Vec3> &xb);

}  // namespace mvs::core
