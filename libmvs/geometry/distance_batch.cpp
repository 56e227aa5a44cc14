// Evaluates all cases of distance.h, and selects one for each pair by masks. Every sum is in the
// order that Eigen uses in distance.h: (x + y) + z.
#include "geometry/distance_batch.h"

#include "base/simd.h"

namespace mvs::core {
namespace {

template <typename V>
struct SimdPoint {
  typename V::Value x, y, z;
};

template <typename V>
struct DistanceKernel {
  using Value = typename V::Value;
  using Mask = typename V::Mask;
  using Point = SimdPoint<V>;

  MVS_INLINE static void read(const DistanceBatch &batch, uint32_t point, uint32_t pair, Point &p) {
    load<V>(p.x, &batch.at[3 * point][pair]);
    load<V>(p.y, &batch.at[3 * point + 1][pair]);
    load<V>(p.z, &batch.at[3 * point + 2][pair]);
  }
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
  MVS_INLINE static void clamp(Value &s) {
    const Value zero = {}, one = zero + 1;
    s = s < zero ? zero : (one < s ? one : s);
  }
  // The squared length of p - s * d.
  MVS_INLINE static void along(const Point &p, const Value &s, const Point &d, Value &square) {
    const Point rest = {p.x - s * d.x, p.y - s * d.y, p.z - s * d.z};
    dot(rest, rest, square);
  }

  // Squared distance to the point of an edge at part / whole of its length, or to its first end.
  MVS_INLINE static void on_edge(const Value &part, const Value &whole, const Mask &is_long,
                                 const Point &p, const Point &edge, Value &square) {
    const Value zero = {};
    const Value s = is_long ? part / whole : zero;
    along(p, s, edge, square);
  }

  // Cases from the last to the first, which overrides the others.
  MVS_INLINE static void triangle(DistanceBatch &batch, uint32_t pair) {
    Point p, a, b, c, ab, ac, bc, ap, bp, cp;
    read(batch, 0, pair, p);
    read(batch, 1, pair, a);
    read(batch, 2, pair, b);
    read(batch, 3, pair, c);
    subtract(b, a, ab);
    subtract(c, a, ac);
    subtract(c, b, bc);
    subtract(p, a, ap);
    subtract(p, b, bp);
    subtract(p, c, cp);
    Value d1, d2, d3, d4, d5, d6, square, other;
    dot(ab, ap, d1);
    dot(ac, ap, d2);
    dot(ab, bp, d3);
    dot(ac, bp, d4);
    dot(ab, cp, d5);
    dot(ac, cp, d6);
    const Value zero = {}, one = zero + 1;
    const Value vc = d1 * d4 - d3 * d2, vb = d5 * d2 - d1 * d6, va = d3 * d6 - d5 * d4;
    const Value scale = one / (va + vb + vc), v = vb * scale, w = vc * scale;
    const Point flat = {ap.x - v * ab.x - w * ac.x, ap.y - v * ab.y - w * ac.y,
                        ap.z - v * ab.z - w * ac.z};
    dot(flat, flat, square);
    const Value up = d4 - d3, down = d5 - d6, span = up + down;
    on_edge(up, span, span > zero, bp, bc, other);
    choose((va <= zero) & (up >= zero) & (down >= zero), other, square);
    on_edge(d2, d2 - d6, d2 > d6, ap, ac, other);
    choose((vb <= zero) & (d2 >= zero) & (d6 <= zero), other, square);
    dot(cp, cp, other);
    choose((d6 >= zero) & (d5 <= d6), other, square);
    on_edge(d1, d1 - d3, d1 > d3, ap, ab, other);
    choose((vc <= zero) & (d1 >= zero) & (d3 <= zero), other, square);
    dot(bp, bp, other);
    choose((d3 >= zero) & (d4 <= d3), other, square);
    dot(ap, ap, other);
    choose((d1 <= zero) & (d2 <= zero), other, square);
    store<V>(&batch.distance2[pair], square);
  }

  // Clamped parameter part / a on a segment of squared length a.
  MVS_INLINE static void at_end(const Value &part, const Value &a, Value &s) {
    const Value zero = {};
    s = part / a;
    clamp(s);
    s = a > zero ? s : zero;
  }

  MVS_INLINE static void segments(DistanceBatch &batch, uint32_t pair) {
    Point p0, p1, q0, q1, d1, d2, r;
    read(batch, 0, pair, p0);
    read(batch, 1, pair, p1);
    read(batch, 2, pair, q0);
    read(batch, 3, pair, q1);
    subtract(p1, p0, d1);
    subtract(q1, q0, d2);
    subtract(p0, q0, r);
    Value a, b, c, e, f, at_start, at_other, square;
    dot(d1, d1, a);
    dot(d2, d2, e);
    dot(d2, r, f);
    dot(d1, d2, b);
    dot(d1, r, c);
    at_end(-c, a, at_start);
    at_end(b - c, a, at_other);
    const Value zero = {}, one = zero + 1;
    const Value denominator = a * e - b * b;
    Value s = (b * f - c * e) / denominator;
    clamp(s);
    s = denominator > 1e-12 * a * e ? s : 0.5 * (at_start + at_other);
    Value t = e > zero ? (b * s + f) / e : zero;
    const Mask below = t<zero, above = t> one;
    choose(below, at_start, s);
    choose(above, at_other, s);
    choose(below, zero, t);
    choose(above, one, t);
    const Point gap = {r.x + s * d1.x - t * d2.x, r.y + s * d1.y - t * d2.y,
                       r.z + s * d1.z - t * d2.z};
    dot(gap, gap, square);
    store<V>(&batch.distance2[pair], square);
  }

  MVS_INLINE static void farthest(DistanceBatch &batch, uint32_t pair, uint32_t split) {
    Value most = {}, square;
    for (uint32_t i = 0; i < split; ++i) {
      Point a, b, difference;
      read(batch, i, pair, a);
      for (uint32_t j = split; j < 4; ++j) {
        read(batch, j, pair, b);
        subtract(a, b, difference);
        dot(difference, difference, square);
        most = most < square ? square : most;
      }
    }
    store<V>(&batch.distance2[pair], most);
  }
};

template <typename V>
MVS_INLINE void all_triangles(DistanceBatch &batch, uint32_t count) {
  for (uint32_t pair = 0; pair < count; pair += V::width) DistanceKernel<V>::triangle(batch, pair);
}

template <typename V>
MVS_INLINE void all_segments(DistanceBatch &batch, uint32_t count) {
  for (uint32_t pair = 0; pair < count; pair += V::width) DistanceKernel<V>::segments(batch, pair);
}

template <typename V>
MVS_INLINE void all_farthest(DistanceBatch &batch, uint32_t count, uint32_t split) {
  for (uint32_t pair = 0; pair < count; pair += V::width) {
    if (split == 1) {
      DistanceKernel<V>::farthest(batch, pair, 1);
    } else {
      DistanceKernel<V>::farthest(batch, pair, 2);
    }
  }
}

}  // namespace

void measure_triangles(DistanceBatch &batch, uint32_t count) {
  static const auto kernel = simd_kernel<&all_triangles<Double2>, &all_triangles<Double4>>();
  kernel(batch, count);
}

void measure_segments(DistanceBatch &batch, uint32_t count) {
  static const auto kernel = simd_kernel<&all_segments<Double2>, &all_segments<Double4>>();
  kernel(batch, count);
}

void measure_farthest(DistanceBatch &batch, uint32_t count, uint32_t split) {
  static const auto kernel = simd_kernel<&all_farthest<Double2>, &all_farthest<Double4>>();
  kernel(batch, count, split);
}

}  // namespace mvs::core
