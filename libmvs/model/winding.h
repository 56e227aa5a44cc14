// The connected parts of a sheet, and which of their triangles are wound against the others.
#pragma once

#include "model/sides.h"

namespace mvs::core {

struct Winding {
  uint32_t component_count = 0;
  std::vector<uint32_t> component;  // of each triangle; numbered in the order of their first one
  std::vector<uint8_t> against;     // 1: wound against the first triangle of its component
  std::vector<Edge> conflicts;      // edges at which no choice agrees: a sheet with one side
};

// Triangles are connected over edges that join exactly two of them.
Winding find_winding(const std::vector<Tri> &triangles, const std::vector<Side> &sides);

}  // namespace mvs::core
