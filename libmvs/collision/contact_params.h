// Ranges of contact and of its barriers, over the contact thickness and over distances at rest.
#pragma once

namespace mvs::core {

// A vertex and a triangle are in contact if they were this many contact thicknesses apart at rest.
inline constexpr double contact_rest_distance = 1.5;
// Range of a barrier, as a share of the contact thickness and of the pair's distance at rest.
inline constexpr double barrier_share = 0.2;
inline constexpr double barrier_rest_share = 0.4;

inline double barrier_range(double thickness, double rest_distance) {
  const double a = barrier_share * thickness, b = barrier_rest_share * rest_distance;
  return a < b ? a : b;
}

}  // namespace mvs::core
