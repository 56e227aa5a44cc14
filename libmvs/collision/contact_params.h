// The ranges at which parts of the sheet act on each other.
#pragma once

namespace mvs::core {

inline constexpr double facing_rest_distance = 1.5;  // times the contact thickness
inline constexpr double guard_share = 0.2;           // of the contact thickness
inline constexpr double guard_rest_share = 0.4;      // of the pair's distance at rest

inline double guard_range(double thickness, double rest_distance) {
  const double a = guard_share * thickness, b = guard_rest_share * rest_distance;
  return a < b ? a : b;
}

}  // namespace mvs::core
