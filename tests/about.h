// Comparison of two numbers to a relative tolerance.
#pragma once

#include <doctest/doctest.h>

namespace mvs::core::test {

// Equal to a relative tolerance. doctest's own Approx adds 1 to the factor of epsilon, so that
// numbers in metres would always agree (tests/tolerances.py refuses it). Instead a number far below
// any other is added, so that 0 equals 0. Where rounding leaves another number than 0, compare the
// absolute difference.
inline doctest::Approx about(double value, double relative = 1e-5) {
  constexpr double tiny = 1e-250;
  return doctest::Approx(value).epsilon(relative).scale(tiny);
}

}  // namespace mvs::core::test
