// Corners of the difference of two hulls, of which the closest points of both are made.
#pragma once

#include <span>

#include "base/types.h"

namespace mvs::core {

// a[i] - b[j].
struct HullPair {
  Vec3 at;
  uint32_t i, j;
};

inline bool has_pair(std::span<const HullPair> pairs, uint32_t i, uint32_t j) {
  for (const HullPair &p : pairs) {
    if (p.i == i && p.j == j) return true;
  }
  return false;
}

}  // namespace mvs::core
