// Closest points between points, segments and triangles, with the feature that they are on.
#pragma once

#include <algorithm>

#include "base/types.h"

namespace mvs::core {

// A point of a triangle: barycentric weights and the feature it lies on. Features 0..2 are the
// corners, 3..5 the edges (3 + k joins corners k and k + 1), 6 the inside.
struct TrianglePoint {
  std::array<double, 3> weight;
  uint32_t feature;
  double distance2;  // m2, to the query point
};

struct SegmentPoint {
  double s;  // 0 at the first end, 1 at the second
  double distance2;
};

inline SegmentPoint closest_on_segment(const Vec3 &p, const Vec3 &a, const Vec3 &b) {
  const Vec3 ab = b - a;
  const double length2 = ab.squaredNorm();
  const double s = length2 > 0 ? std::clamp((p - a).dot(ab) / length2, 0.0, 1.0) : 0.0;
  return {s, (p - a - s * ab).squaredNorm()};
}

// Closest point by Voronoi regions (Ericson, Real-Time Collision Detection, 2005, section 5.1.5).
inline TrianglePoint closest_on_triangle(const Vec3 &p, const Vec3 &a, const Vec3 &b,
                                         const Vec3 &c) {
  const Vec3 ab = b - a, ac = c - a, ap = p - a;
  const double d1 = ab.dot(ap), d2 = ac.dot(ap);
  if (d1 <= 0 && d2 <= 0) return {{1, 0, 0}, 0, ap.squaredNorm()};

  const Vec3 bp = p - b;
  const double d3 = ab.dot(bp), d4 = ac.dot(bp);
  if (d3 >= 0 && d4 <= d3) return {{0, 1, 0}, 1, bp.squaredNorm()};

  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) {
    const double s = d1 > d3 ? d1 / (d1 - d3) : 0.0;
    return {{1 - s, s, 0}, 3, (ap - s * ab).squaredNorm()};
  }

  const Vec3 cp = p - c;
  const double d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d6 >= 0 && d5 <= d6) return {{0, 0, 1}, 2, cp.squaredNorm()};

  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) {
    const double s = d2 > d6 ? d2 / (d2 - d6) : 0.0;
    return {{1 - s, 0, s}, 5, (ap - s * ac).squaredNorm()};
  }

  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
    const double span = (d4 - d3) + (d5 - d6);
    const double s = span > 0 ? (d4 - d3) / span : 0.0;
    return {{0, 1 - s, s}, 4, (bp - s * (c - b)).squaredNorm()};
  }

  const double scale = 1 / (va + vb + vc);
  const double v = vb * scale, w = vc * scale;
  return {{1 - v - w, v, w}, 6, (ap - v * ab - w * ac).squaredNorm()};
}

// Closest points of two segments: p0 + s (p1 - p0) and q0 + t (q1 - q0).
struct SegmentPair {
  double s, t;
  double distance2;
};

// Section 5.1.9 of the same book, clamped. Parallel segments take the middle of their overlap, so
// that the result does not jump from end to end as they turn.
inline SegmentPair closest_of_segments(const Vec3 &p0, const Vec3 &p1, const Vec3 &q0,
                                       const Vec3 &q1) {
  const Vec3 d1 = p1 - p0, d2 = q1 - q0, r = p0 - q0;
  const double a = d1.squaredNorm(), e = d2.squaredNorm(), f = d2.dot(r);
  const double b = d1.dot(d2), c = d1.dot(r);
  const double denominator = a * e - b * b;
  double s;
  if (denominator > 1e-12 * a * e) {
    s = std::clamp((b * f - c * e) / denominator, 0.0, 1.0);
  } else {
    const double s0 = a > 0 ? std::clamp(-c / a, 0.0, 1.0) : 0.0;
    const double s1 = a > 0 ? std::clamp((b - c) / a, 0.0, 1.0) : 0.0;
    s = 0.5 * (s0 + s1);
  }
  double t = e > 0 ? (b * s + f) / e : 0.0;
  if (t < 0) {
    t = 0;
    s = a > 0 ? std::clamp(-c / a, 0.0, 1.0) : 0.0;
  } else if (t > 1) {
    t = 1;
    s = a > 0 ? std::clamp((b - c) / a, 0.0, 1.0) : 0.0;
  }
  return {s, t, (r + s * d1 - t * d2).squaredNorm()};
}

// Returns the squared distance of a segment and a triangle that do not intersect: that of an end of
// the segment to the triangle, or of the segment and an edge.
inline double segment_triangle_distance2(const Vec3 &p, const Vec3 &q, const Vec3 &a, const Vec3 &b,
                                         const Vec3 &c) {
  return std::min(
      {closest_on_triangle(p, a, b, c).distance2, closest_on_triangle(q, a, b, c).distance2,
       closest_of_segments(p, q, a, b).distance2, closest_of_segments(p, q, b, c).distance2,
       closest_of_segments(p, q, c, a).distance2});
}

}  // namespace mvs::core
