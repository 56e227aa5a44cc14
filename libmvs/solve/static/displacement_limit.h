// The region that a local subproblem was cut out for: its settle ends when a node would leave it.
#pragma once

#include <utility>
#include <vector>

#include "base/types.h"

namespace mvs::core {

class DisplacementLimit {
 public:
  // No node is limited.
  DisplacementLimit() = default;
  // Nodes stay within this distance, m, of their origins.
  DisplacementLimit(double distance, std::vector<Vec3> origin)
      : distance_(distance), origin_(std::move(origin)) {}

  bool is_set() const { return distance_ > 0; }
  // Whether a node was stopped.
  bool reached() const { return reached_; }
  // Stops the nodes whose step from x leads beyond the limit.
  void stop(const std::vector<Vec3> &x, std::vector<Vec3> &step) {
    for (size_t i = 0; i < origin_.size(); ++i) {
      const Vec3 from_origin = x[i] + step[i] - origin_[i];
      if (from_origin.squaredNorm() <= distance_ * distance_) continue;
      step[i].setZero();
      reached_ = true;
    }
  }

 private:
  double distance_ = 0;       // m; 0: unlimited
  std::vector<Vec3> origin_;  // m, of the nodes
  bool reached_ = false;
};

}  // namespace mvs::core
