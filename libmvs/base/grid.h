// Pairs of axis-aligned boxes that overlap, by a uniform grid.
#pragma once

#include <vector>

#include "base/types.h"

namespace mvs {

// Every pair (a, b), a < b, of boxes low[i] .. high[i] that overlap, once each, in an order that
// depends on the boxes alone.
void overlapping_boxes(const std::vector<Vec3> &low, const std::vector<Vec3> &high,
                       std::vector<Edge> &pairs);

// Every pair (point, box) with the point inside the box, ascending by point, then box.
void points_in_boxes(const std::vector<Vec3> &points, const std::vector<Vec3> &low,
                     const std::vector<Vec3> &high, std::vector<Edge> &pairs);

}  // namespace mvs
