// Linear motion of all nodes during one step, with a slack around it, and how near it brings two
// sets of nodes.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "geometry/swept_aabb_batch.h"

namespace mvs::core {

struct NodeMotion {
  std::vector<Vec3> from, to;      // m
  std::vector<Vec3> middle, half;  // of the motion; from there to its end
  double slack = 0;                // m, distance that a node may be off its segment
  StepMotion mode = StepMotion::together;

  void set(const std::vector<Vec3> &from_in, const std::vector<Vec3> &to_in, double slack_in,
           StepMotion mode_in);
  bool is_independent() const { return mode == StepMotion::independent; }

  // Returns whether each node is within the slack of its segment, and, where all move together, of
  // the same share of it. If it holds for two places, it holds for the segments between them.
  bool contains(const std::vector<Vec3> &x) const;

  // Returns a bound on how much nearer than in the middle of the motion points of the convex hulls
  // of two sets of nodes come. If all nodes move together, only their relative motion counts: the
  // difference of two convex combinations is a convex combination of differences.
  template <typename A, typename B>
  double max_approach(const A &a, const B &b) const {
    double together2 = 0, of_a2 = 0, of_b2 = 0;
    for (const uint32_t i : a) {
      of_a2 = std::max(of_a2, half[i].squaredNorm());
      for (const uint32_t j : b) {
        together2 = std::max(together2, (half[i] - half[j]).squaredNorm());
        of_b2 = std::max(of_b2, half[j].squaredNorm());
      }
    }
    return 2 * slack +
           (is_independent() ? std::sqrt(of_a2) + std::sqrt(of_b2) : std::sqrt(together2));
  }
};

}  // namespace mvs::core
