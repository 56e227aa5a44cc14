// Coaptation: tissue that faces other tissue within the contact thickness.
#pragma once

#include <array>
#include <vector>

#include "model/model.h"

namespace mvs::core {

// A point of the coaptation line with the coaptation length there.
struct CoaptationStation {
  Vec3 point;
  double length;  // m, along the tissue across the line
};

struct Coaptation {
  std::vector<double> distance;         // m per node, infinity for a node that faces no tissue
  std::vector<double> share;            // per triangle, 0..1
  std::vector<CoaptationStation> line;  // in order; several lines are concatenated
  std::vector<uint32_t> line_end;       // of each line: the index behind its last station
  std::vector<std::array<uint32_t, 2>> line_leaflets;  // of each line: that meet there
  // Of each line: as many stations whatever its length, for what has to be continuous.
  std::vector<std::vector<CoaptationStation>> profile;
  double area = 0, length_mean = 0, length_min = 0, length_max = 0, height = 0, depth = 0;
};
Coaptation measure_coaptation(const Model &model, const std::vector<Vec3> &x);

}  // namespace mvs::core
