// Axis-aligned bounding box of points.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "base/types.h"

namespace mvs::core {

struct Aabb {
  Vec3 low = Vec3::Constant(1e300), high = Vec3::Constant(-1e300);

  double longest_side() const { return (high - low).maxCoeff(); }
  void add(const Vec3 &p) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  void add(const Aabb &other) {
    low = low.cwiseMin(other.low);
    high = high.cwiseMax(other.high);
  }
  bool overlaps(const Aabb &other) const {
    return (low.array() <= other.high.array()).all() && (other.low.array() <= high.array()).all();
  }
  double distance2(const Vec3 &p) const {
    double sum = 0;
    for (int k = 0; k < 3; ++k) {
      const double off = std::max(std::max(0.0, low[k] - p[k]), p[k] - high[k]);
      sum += off * off;
    }
    return sum;
  }
  double distance2(const Aabb &other) const {
    double sum = 0;
    for (int k = 0; k < 3; ++k) {
      const double off = std::max({0.0, low[k] - other.high[k], other.low[k] - high[k]});
      sum += off * off;
    }
    return sum;
  }
};

inline Aabb aabb_of(std::span<const Vec3> points) {
  Aabb box;
  for (const Vec3 &p : points) box.add(p);
  return box;
}

inline Aabb aabb_of(const std::vector<Vec3> &x, const Tri &triangle) {
  Aabb box;
  for (const uint32_t node : triangle) box.add(x[node]);
  return box;
}

}  // namespace mvs::core
