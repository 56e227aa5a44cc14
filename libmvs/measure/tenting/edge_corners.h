// Balls that touch a free edge at a vertex, seen from above.
#pragma once

#include <array>
#include <cstddef>

#include "base/types.h"

namespace mvs::core {

// The centres of balls that touch a free edge at a vertex from one side, seen from above: both
// edges where the ball lies in the corner; else the vertex itself, across from the middle and at
// right angles to both edges. `side`: 1 is left of the edge, -1 right.
struct Corner {
  std::array<Vec3, 3> centre;
  size_t count = 0;
};
Corner corner_of(const Vec3 &before, const Vec3 &at, const Vec3 &after, double side, double radius);

}  // namespace mvs::core
