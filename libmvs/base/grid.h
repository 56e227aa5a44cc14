// Pairs of axis-aligned boxes that overlap, by a uniform grid.
#pragma once

#include <vector>

#include "base/types.h"

namespace mvs {

// Every pair (a, b), a < b, of boxes low[i] .. high[i] that overlap, sorted.
void overlapping_boxes(const std::vector<Vec3> &low, const std::vector<Vec3> &high,
                       std::vector<Edge> &pairs);

}  // namespace mvs
