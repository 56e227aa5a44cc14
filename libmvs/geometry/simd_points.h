// Points as SIMD vectors, and the point of a triangle that is nearest to each. Every sum is in the
// order that Eigen uses in distance.h: (x + y) + z.
#pragma once

#include "base/simd.h"

namespace mvs::core {

template <typename V>
struct SimdPoints {
  using Value = typename V::Value;
  using Mask = typename V::Mask;
  struct Point {
    Value x, y, z;
  };

  MVS_INLINE static void subtract(const Point &a, const Point &b, Point &difference) {
    difference.x = a.x - b.x;
    difference.y = a.y - b.y;
    difference.z = a.z - b.z;
  }
  MVS_INLINE static void dot(const Point &a, const Point &b, Value &sum) {
    sum = (a.x * b.x + a.y * b.y) + a.z * b.z;
  }
  MVS_INLINE static void choose(const Mask &where, const Value &value, Value &otherwise) {
    otherwise = where ? value : otherwise;
  }
  // The squared length of p - s * d.
  MVS_INLINE static void along(const Point &p, const Value &s, const Point &d, Value &square) {
    const Point rest = {p.x - s * d.x, p.y - s * d.y, p.z - s * d.z};
    dot(rest, rest, square);
  }

  // Barycentric weights of a point of a triangle, and its squared distance.
  struct Nearest {
    Value u, v, w, distance2;
  };
  MVS_INLINE static void choose(const Mask &where, const Nearest &value, Nearest &otherwise) {
    choose(where, value.u, otherwise.u);
    choose(where, value.v, otherwise.v);
    choose(where, value.w, otherwise.w);
    choose(where, value.distance2, otherwise.distance2);
  }

  // closest_on_triangle() of distance.h: all its cases, from the last to the first, which overrides
  // the others.
  MVS_INLINE static void nearest(const Point &p, const Point &a, const Point &b, const Point &c,
                                 Nearest &found) {
    Point ab, ac, bc, ap, bp, cp;
    subtract(b, a, ab);
    subtract(c, a, ac);
    subtract(c, b, bc);
    subtract(p, a, ap);
    subtract(p, b, bp);
    subtract(p, c, cp);
    Value d1, d2, d3, d4, d5, d6;
    dot(ab, ap, d1);
    dot(ac, ap, d2);
    dot(ab, bp, d3);
    dot(ac, bp, d4);
    dot(ab, cp, d5);
    dot(ac, cp, d6);
    const Value zero = {}, one = zero + 1;
    const Value vc = d1 * d4 - d3 * d2, vb = d5 * d2 - d1 * d6, va = d3 * d6 - d5 * d4;
    const Value scale = one / (va + vb + vc);
    found.v = vb * scale;
    found.w = vc * scale;
    found.u = one - found.v - found.w;
    const Point flat = {ap.x - found.v * ab.x - found.w * ac.x,
                        ap.y - found.v * ab.y - found.w * ac.y,
                        ap.z - found.v * ab.z - found.w * ac.z};
    dot(flat, flat, found.distance2);
    const Value up = d4 - d3, down = d5 - d6, span = up + down;
    Value s = span > zero ? up / span : zero;
    Nearest other = {zero, one - s, s, zero};
    along(bp, s, bc, other.distance2);
    choose((va <= zero) & (up >= zero) & (down >= zero), other, found);
    s = d2 > d6 ? d2 / (d2 - d6) : zero;
    other = {one - s, zero, s, zero};
    along(ap, s, ac, other.distance2);
    choose((vb <= zero) & (d2 >= zero) & (d6 <= zero), other, found);
    other = {zero, zero, one, zero};
    dot(cp, cp, other.distance2);
    choose((d6 >= zero) & (d5 <= d6), other, found);
    s = d1 > d3 ? d1 / (d1 - d3) : zero;
    other = {one - s, s, zero, zero};
    along(ap, s, ab, other.distance2);
    choose((vc <= zero) & (d1 >= zero) & (d3 <= zero), other, found);
    other = {zero, one, zero, zero};
    dot(bp, bp, other.distance2);
    choose((d3 >= zero) & (d4 <= d3), other, found);
    other = {one, zero, zero, zero};
    dot(ap, ap, other.distance2);
    choose((d1 <= zero) & (d2 <= zero), other, found);
  }
};

}  // namespace mvs::core
