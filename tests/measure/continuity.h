// A figure that has no jump.
#pragma once

#include <doctest/doctest.h>

#include <cmath>
#include <functional>

namespace mvs::core::test {

// Bisects the largest of some steps of a figure from 0 to 1, always to the half with the larger
// change: a jump stays as large. Of a continuous figure a step of 2^-20 of the first has less than
// a thousandth of it left, unless its slope there is a thousand times that of the whole step.
inline void check_continuous(const std::function<double(double)> &figure, int steps = 200) {
  double low = 0, at_low = 0, at_high = 0, last = figure(0);
  for (int k = 0; k < steps; ++k) {
    const double next = figure((k + 1.0) / steps);
    if (k == 0 || std::abs(next - last) > std::abs(at_high - at_low)) {
      low = static_cast<double>(k) / steps;
      at_low = last;
      at_high = next;
    }
    last = next;
  }
  const double coarse = std::abs(at_high - at_low);
  double width = 1.0 / steps;
  for (int k = 0; k < 20; ++k) {
    width *= 0.5;
    const double middle = figure(low + width);
    if (std::abs(middle - at_low) > std::abs(at_high - middle)) {
      at_high = middle;
    } else {
      at_low = middle;
      low += width;
    }
  }
  CAPTURE(low);
  CHECK(std::abs(at_high - at_low) < 1e-3 * coarse);
}

}  // namespace mvs::core::test
