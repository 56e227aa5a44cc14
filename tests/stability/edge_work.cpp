#include "tests/stability/edge_work.h"

#include <algorithm>
#include <map>

namespace stability {

EdgeWork::EdgeWork(const mvs::Snapshot &valve) {
  const auto kinds = valve.view<uint8_t>(MVS_ARRAY_NODE_KIND);
  const auto triangles = valve.view<uint32_t>(MVS_ARRAY_TRIANGLE_NODES);
  const double *rest = valve.view<double>(MVS_ARRAY_NODE_REST).row(0);
  origin_ = {rest[0], rest[1], rest[2]};
  std::map<std::array<uint32_t, 2>, int> sides;
  for (size_t t = 0; t < triangles.rows(); ++t) {
    for (size_t k = 0; k < 3; ++k) {
      const uint32_t a = triangles.row(t)[k], b = triangles.row(t)[(k + 1) % 3];
      ++sides[{std::min(a, b), std::max(a, b)}];
    }
  }
  for (size_t t = 0; t < triangles.rows(); ++t) {
    for (size_t k = 0; k < 3; ++k) {
      const uint32_t a = triangles.row(t)[k], b = triangles.row(t)[(k + 1) % 3];
      const bool held =
          kinds.data()[a] == MVS_NODE_KIND_ANNULUS && kinds.data()[b] == MVS_NODE_KIND_ANNULUS;
      if (sides[{std::min(a, b), std::max(a, b)}] == 1 && !held) edges_.push_back({a, b});
    }
  }
}

double EdgeWork::slope(const double *from, const double *to, double share) const {
  const auto at = [&](uint32_t node) {
    Point p;
    for (size_t k = 0; k < 3; ++k) {
      const double x = from[3 * node + k];
      p[k] = x + share * (to[3 * node + k] - x) - origin_[k];
    }
    return p;
  };
  double sum = 0;
  for (const auto &[i, j] : edges_) {
    const Point a = at(i), b = at(j);
    const Point cross = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                         a[0] * b[1] - a[1] * b[0]};
    for (size_t k = 0; k < 3; ++k) {
      sum += cross[k] * (to[3 * i + k] - from[3 * i + k] + to[3 * j + k] - from[3 * j + k]);
    }
  }
  return sum / 6;
}

double EdgeWork::held(const double *from, const double *to) const {
  return slope(from, to, 0);
}

// The slope is quadratic in the share: Simpson's rule is exact.
double EdgeWork::followed(const double *from, const double *to) const {
  return (slope(from, to, 0) + 4 * slope(from, to, 0.5) + slope(from, to, 1)) / 6;
}

}  // namespace stability
