// Distances and depths of segments and triangles a third time: by all features, in long double, and
// by all separating axes. Slow and simple, to decide between two that disagree.
#pragma once

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/types.h"

namespace mvs::core {

using Triangle = std::array<Vec3, 3>;
using Segment = std::array<Vec3, 2>;

using Long3 = Eigen::Matrix<long double, 3, 1>;

inline long double distance2(const Long3 &p, const Long3 &a, const Long3 &b) {
  const Long3 ab = b - a;
  const long double length2 = ab.squaredNorm();
  const long double s = length2 > 0 ? std::clamp((p - a).dot(ab) / length2, 0.0L, 1.0L) : 0.0L;
  return (p - a - s * ab).squaredNorm();
}

inline double third_distance(const Segment &first, const Segment &second) {
  const Long3 a = first[0].cast<long double>(), b = first[1].cast<long double>();
  const Long3 c = second[0].cast<long double>(), d = second[1].cast<long double>();
  long double least =
      std::min({distance2(a, c, d), distance2(b, c, d), distance2(c, a, b), distance2(d, a, b)});
  const Long3 u = b - a, v = d - c, w = a - c;
  const long double uu = u.squaredNorm(), uv = u.dot(v), vv = v.squaredNorm();
  const long double det = uu * vv - uv * uv;
  if (det > 0) {
    const long double s = (uv * v.dot(w) - vv * u.dot(w)) / det;
    const long double t = (uu * v.dot(w) - uv * u.dot(w)) / det;
    if (s >= 0 && s <= 1 && t >= 0 && t <= 1)
      least = std::min(least, (w + s * u - t * v).squaredNorm());
  }
  return static_cast<double>(std::sqrt(least));
}

inline double third_distance(const Vec3 &point, const Triangle &t) {
  const Long3 p = point.cast<long double>(), a = t[0].cast<long double>();
  const Long3 b = t[1].cast<long double>(), c = t[2].cast<long double>();
  long double least = std::min({distance2(p, a, b), distance2(p, b, c), distance2(p, c, a)});
  const Long3 u = b - a, v = c - a, w = p - a;
  const long double uu = u.squaredNorm(), uv = u.dot(v), vv = v.squaredNorm();
  const long double det = uu * vv - uv * uv;
  if (det > 0) {
    const long double s = (vv * u.dot(w) - uv * v.dot(w)) / det;
    const long double r = (uu * v.dot(w) - uv * u.dot(w)) / det;
    if (s >= 0 && r >= 0 && s + r <= 1) least = std::min(least, (w - s * u - r * v).squaredNorm());
  }
  return static_cast<double>(std::sqrt(least));
}

// The distance of two triangles that do not cross.
inline double third_distance(const Triangle &a, const Triangle &b) {
  double least = third_distance(a[0], b);
  for (size_t k = 0; k < 3; ++k) {
    least = std::min({least, third_distance(a[k], b), third_distance(b[k], a)});
    for (size_t j = 0; j < 3; ++j) {
      least = std::min(
          least, third_distance(Segment{a[k], a[(k + 1) % 3]}, Segment{b[j], b[(j + 1) % 3]}));
    }
  }
  return least;
}

// An upper bound of the depth of two bodies that cross: the least overlap along the axes of the
// separating axis test. 0 for flat contact.
template <size_t N, size_t M>
double depth(const std::array<Vec3, N> &a, const std::array<Vec3, M> &b) {
  double least = 1;
  const auto try_axis = [&](const Vec3 &axis) {
    if (axis.norm() < 1e-12) return;
    std::array<double, 4> range = {1e9, -1e9, 1e9, -1e9};
    for (const Vec3 &p : a) {
      range[0] = std::min(range[0], p.dot(axis.normalized()));
      range[1] = std::max(range[1], p.dot(axis.normalized()));
    }
    for (const Vec3 &p : b) {
      range[2] = std::min(range[2], p.dot(axis.normalized()));
      range[3] = std::max(range[3], p.dot(axis.normalized()));
    }
    least = std::min({least, range[1] - range[2], range[3] - range[0]});
  };
  std::vector<Vec3> sides, normals;
  for (size_t k = 0; k < N; ++k) sides.push_back(a[(k + 1) % N] - a[k]);
  for (size_t k = 0; k < M; ++k) sides.push_back(b[(k + 1) % M] - b[k]);
  for (size_t j = 0; j < sides.size(); ++j) {
    for (size_t k = 0; k < j; ++k) normals.push_back(1e3 * sides[j].cross(sides[k]));
  }
  for (const Vec3 &n : normals) {
    try_axis(n);
    for (const Vec3 &side : sides) try_axis(1e3 * n.cross(side));
  }
  for (const Vec3 &side : sides) try_axis(side);
  return least;
}

}  // namespace mvs::core
