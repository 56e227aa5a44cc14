// Swept axis-aligned boxes in double precision: a box at each end of a linear motion, and the test
// whether two of them keep apart during the whole motion.
#pragma once

#include <algorithm>
#include <vector>

#include "base/types.h"

namespace mvs::core {

// Whether all nodes take the same share of their motion at a time, or each node any share.
enum class StepMotion { together, independent };

// Boxes around a set of nodes at both ends of their motion. For independent nodes both are the box
// of the whole motion.
struct SweptAabb {
  struct Box {
    std::array<double, 3> low{1e300, 1e300, 1e300}, high{-1e300, -1e300, -1e300};
    void add(const double *p) {
      for (int k = 0; k < 3; ++k) {
        low[k] = std::min(low[k], p[k]);
        high[k] = std::max(high[k], p[k]);
      }
    }
    void add(const Box &other) {
      add(other.low.data());
      add(other.high.data());
    }
  };
  Box start, end;

  void add(const SweptAabb &other) {
    start.add(other.start);
    end.add(other.end);
  }

  template <typename Nodes>
  static SweptAabb of(const Nodes &nodes, const std::vector<Vec3> &x, const std::vector<Vec3> &to,
                      StepMotion mode) {
    SweptAabb box;
    for (const uint32_t i : nodes) {
      box.start.add(x[i].data());
      box.end.add(to[i].data());
    }
    if (mode == StepMotion::independent) {
      box.start.add(box.end);
      box.end = box.start;
    }
    return box;
  }
};

// Returns whether two swept boxes keep more than `margin` apart. Their sides move no faster than
// linearly towards each other, so that a gap along one axis at both ends is a gap all the time.
inline bool apart(const SweptAabb &a, const SweptAabb &b, double margin) {
  for (uint32_t k = 0; k < 3; ++k) {
    if (a.start.low[k] - b.start.high[k] > margin && a.end.low[k] - b.end.high[k] > margin) {
      return true;
    }
    if (b.start.low[k] - a.start.high[k] > margin && b.end.low[k] - a.end.high[k] > margin) {
      return true;
    }
  }
  return false;
}

}  // namespace mvs::core
