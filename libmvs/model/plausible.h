// Check that the numbers of a given state can be those of a valve: a state that is far off is
// damage or in another unit, and the search for contacts would need a grid of that size.
#pragma once

#include "base/types.h"

namespace mvs::core {

// m; nodes move by centimetres.
inline constexpr double most_from_rest = 1;
// m/s; tissue that the largest pressure throws over the valve reaches a tenth of it.
inline constexpr double most_speed = 1000;

// Both are false for NaN and infinity.
inline bool is_near_rest(const Vec3 &now, const Vec3 &rest) {
  return (now - rest).norm() < most_from_rest;
}
inline bool is_speed(const Vec3 &velocity) {
  return velocity.norm() < most_speed;
}

}  // namespace mvs::core
