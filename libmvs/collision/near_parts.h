// Parts of the tissue near the box around the motion of an instrument.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "geometry/aabb.h"

namespace mvs::core {

// Returns a bit for each side of a box that a place is outside of.
inline uint8_t sides_outside(const Aabb &box, const Vec3 &place) {
  uint32_t bits = 0;
  for (int k = 0; k < 3; ++k) {
    bits |= static_cast<uint32_t>(place[k] < box.low[k]) << (2 * k);
    bits |= static_cast<uint32_t>(place[k] > box.high[k]) << (2 * k + 1);
  }
  return static_cast<uint8_t>(bits);
}

inline void sort_unique(std::vector<uint32_t> &numbers) {
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
}

// Returns whether the hull of points is farther than `reach` from a box along one axis.
inline bool is_apart(const Aabb &box, std::span<const Vec3> part, double reach) {
  Vec3 low = part[0], high = part[0];
  for (const Vec3 &p : part.subspan(1)) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  return ((low - box.high).array() > reach).any() || ((box.low - high).array() > reach).any();
}

}  // namespace mvs::core
