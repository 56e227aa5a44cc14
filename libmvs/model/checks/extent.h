// Middle and size of a valve, and the distance from it beyond which a place is refused.
#pragma once

#include "model/valve.h"

namespace mvs::core {

// Robust against single stray nodes: from medians of the rest shape.
struct Extent {
  Vec3 centre;
  double size;  // m: twice the median distance of the nodes from the centre
};
Extent extent_of(const Valve &valve);

// Whether a place is farther from the middle than ten times the size, or not a number: in mm or of
// another frame.
bool is_far(const Extent &extent, const Vec3 &place);

}  // namespace mvs::core
