// Where a thing goes in one step: boxes at both ends of its way.
#pragma once

#include <algorithm>
#include <vector>

#include "base/types.h"

namespace mvs::core {

enum class StepMotion { together, independent };

// Where something is at the two ends of its way, in boxes; for what goes for itself both are the
// box of the whole way.
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
                      StepMotion pace) {
    SweptAabb way;
    for (const uint32_t i : nodes) {
      way.start.add(x[i].data());
      way.end.add(to[i].data());
    }
    if (pace == StepMotion::independent) {
      way.start.add(way.end);
      way.end = way.start;
    }
    return way;
  }
};

// Whether two ways keep more than `margin` between them. The sides of the boxes move no faster than
// linearly towards each other, so that a gap along one axis which is there at both ends is there
// all the way.
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
