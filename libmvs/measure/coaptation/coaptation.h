// Where leaflets face each other within the contact thickness.
#pragma once

#include <vector>

#include "model/model.h"

namespace mvs::core {

// A place on the coaptation line and how long the leaflets lie together there.
struct CoaptationStation {
  Vec3 point;
  double length;  // m, along the tissue across the line
};

struct Coaptation {
  std::vector<double> distance;         // m per node, infinity where nothing faces it
  std::vector<double> share;            // per triangle, 0..1
  std::vector<CoaptationStation> line;  // in order; one line after the other
  double area = 0, length_mean = 0, length_min = 0, length_max = 0, height = 0, depth = 0;
};
Coaptation measure_coaptation(const Model &model, const std::vector<Vec3> &x);

}  // namespace mvs::core
