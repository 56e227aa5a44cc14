// Connected components of a sheet, and the triangles with inconsistent winding.
#pragma once

#include "model/sides.h"

namespace mvs::core {

struct Winding {
  uint32_t component_count = 0;
  std::vector<uint32_t> component;  // of each triangle; numbered by first triangle
  std::vector<uint8_t> against;     // 1: wound against the first triangle of its component
  std::vector<Edge> conflicts;      // edges without a consistent winding: a one-sided sheet
};

// Triangles are connected across edges that join exactly two of them.
Winding find_winding(const std::vector<Tri> &triangles, const std::vector<Side> &sides);

}  // namespace mvs::core
