// Upper envelope of the sections in one cell of a row, and the mean height that counts for the
// cell.
#pragma once

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "measure/tenting/row_sections.h"

namespace mvs::core {

// A linear part of the upper envelope: its length and the heights at its ends.
struct Stretch {
  double length, at_from, at_to;

  double integral() const { return 0.5 * length * (at_from + at_to); }
  // The length of the part above a height, and the integral over the height there.
  std::pair<double, double> above(double height) const {
    const double a = at_from - height, b = at_to - height;
    if (a <= 0 && b <= 0) return {0.0, 0.0};
    if (a >= 0 && b >= 0) return {length, 0.5 * length * (a + b)};
    const double most = std::max(a, b), part = length * most / std::abs(a - b);
    return {part, 0.5 * part * most};
  }
};

// Appends the highest of some sections over an interval that all of them cover. The largest of
// linear functions is convex: one that is the highest at both ends is so in between.
void add_highest(const std::vector<const Section *> &layers, double from, double to,
                 std::vector<Stretch> &envelope, int depth = 0);

// The mean height of an envelope of some length, in which tissue far below the rest counts as if it
// were `most` below, but at most the mean of the upper half: it rises with the share of high tissue
// by at most twice the depth. `buffer` is overwritten.
double limited_mean(const std::vector<Stretch> &envelope, double length, double most,
                    std::vector<double> &buffer);

}  // namespace mvs::core
