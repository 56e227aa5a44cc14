// Evaluates all cases of distance.h, and selects one for each pair by masks.
#include "geometry/distance_batch.h"

#include "geometry/simd_points.h"

namespace mvs::core {
namespace {

template <typename V>
struct DistanceKernel : SimdPoints<V> {
  using Value = typename V::Value;
  using Mask = typename V::Mask;
  using typename SimdPoints<V>::Point;
  using SimdPoints<V>::choose, SimdPoints<V>::dot, SimdPoints<V>::subtract;

  MVS_INLINE static void read(const DistanceBatch &batch, uint32_t point, uint32_t pair, Point &p) {
    load<V>(p.x, &batch.at[3 * point][pair]);
    load<V>(p.y, &batch.at[3 * point + 1][pair]);
    load<V>(p.z, &batch.at[3 * point + 2][pair]);
  }
  MVS_INLINE static void clamp(Value &s) {
    const Value zero = {}, one = zero + 1;
    s = s < zero ? zero : (one < s ? one : s);
  }
  MVS_INLINE static void triangle(DistanceBatch &batch, uint32_t pair) {
    Point p, a, b, c;
    read(batch, 0, pair, p);
    read(batch, 1, pair, a);
    read(batch, 2, pair, b);
    read(batch, 3, pair, c);
    typename SimdPoints<V>::Nearest found;
    SimdPoints<V>::nearest(p, a, b, c, found);
    store<V>(&batch.distance2[pair], found.distance2);
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
