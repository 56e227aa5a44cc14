// The ranges at which parts of the sheet act on each other.
#pragma once

namespace mvs::core {

inline constexpr double contact_rest_distance = 1.5;  // times the contact thickness
inline constexpr double barrier_share = 0.2;          // of the contact thickness
inline constexpr double barrier_rest_share = 0.4;     // of the pair's distance at rest

inline double barrier_range(double thickness, double rest_distance) {
  const double a = barrier_share * thickness, b = barrier_rest_share * rest_distance;
  return a < b ? a : b;
}

}  // namespace mvs::core
