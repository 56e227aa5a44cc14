// The cases of distance.h, all of them taken and the right one chosen, with the widest vectors that
// the processor has. Every sum is in the order that Eigen has in distance.h: of three, (x + y) + z.
#include "geometry/distance_batch.h"

#include "base/simd.h"
#include "base/simd_level.h"

namespace mvs::core {
namespace {

// Lying: what is anywhere in memory. Copied by memcpy, wide vectors would go through the stack,
// sixteen bytes at a time. (Not templates: gcc forgets the alignment of those.)
#if defined(__GNUC__)
struct Two {
  static constexpr uint32_t lanes = 2;
  typedef double Value __attribute__((vector_size(16)));
  typedef int64_t Answers __attribute__((vector_size(16)));
  typedef double Lying __attribute__((vector_size(16), aligned(8), may_alias));
};
struct Four {
  static constexpr uint32_t lanes = 4;
  typedef double Value __attribute__((vector_size(32)));
  typedef int64_t Answers __attribute__((vector_size(32)));
  typedef double Lying __attribute__((vector_size(32), aligned(8), may_alias));
};
#else
struct Two {
  static constexpr uint32_t lanes = 1;
  typedef double Value;
  typedef bool Answers;
  typedef double Lying;
};
#endif

template <typename V>
struct Place {
  typename V::Value x, y, z;
};

template <typename V>
struct Kernel {
  using Value = typename V::Value;
  using Answers = typename V::Answers;
  using Point = Place<V>;

  // All by reference: the width of what is passed would depend on the target.
  MVS_INLINE static void take(const double &from, Value &to) {
    to = *reinterpret_cast<const typename V::Lying *>(&from);
  }
  MVS_INLINE static void load(const DistanceBatch &rows, uint32_t point, uint32_t pair, Point &p) {
    take(rows.at[3 * point][pair], p.x);
    take(rows.at[3 * point + 1][pair], p.y);
    take(rows.at[3 * point + 2][pair], p.z);
  }
  MVS_INLINE static void store(const Value &square, DistanceBatch &rows, uint32_t pair) {
    *reinterpret_cast<typename V::Lying *>(&rows.distance2[pair]) = square;
  }
  MVS_INLINE static void subtract(const Point &a, const Point &b, Point &difference) {
    difference.x = a.x - b.x;
    difference.y = a.y - b.y;
    difference.z = a.z - b.z;
  }
  MVS_INLINE static void dot(const Point &a, const Point &b, Value &sum) {
    sum = (a.x * b.x + a.y * b.y) + a.z * b.z;
  }
  MVS_INLINE static void choose(const Answers &where, const Value &value, Value &otherwise) {
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

  // A place on an edge, from / (from - to) of the way, or its first end.
  MVS_INLINE static void on_edge(const Value &part, const Value &whole, const Answers &is_long,
                                 const Point &p, const Point &edge, Value &square) {
    const Value zero = {};
    const Value s = is_long ? part / whole : zero;
    along(p, s, edge, square);
  }

  // From the last case to the first, which decides.
  MVS_INLINE static void triangle(DistanceBatch &rows, uint32_t pair) {
    Point p, a, b, c, ab, ac, bc, ap, bp, cp;
    load(rows, 0, pair, p);
    load(rows, 1, pair, a);
    load(rows, 2, pair, b);
    load(rows, 3, pair, c);
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
    store(square, rows, pair);
  }

  // Where the end of the other segment is nearest on one that is `a` long, squared.
  MVS_INLINE static void at_end(const Value &part, const Value &a, Value &s) {
    const Value zero = {};
    s = part / a;
    clamp(s);
    s = a > zero ? s : zero;
  }

  MVS_INLINE static void segments(DistanceBatch &rows, uint32_t pair) {
    Point p0, p1, q0, q1, d1, d2, r;
    load(rows, 0, pair, p0);
    load(rows, 1, pair, p1);
    load(rows, 2, pair, q0);
    load(rows, 3, pair, q1);
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
    const Answers below = t<zero, above = t> one;
    choose(below, at_start, s);
    choose(above, at_other, s);
    choose(below, zero, t);
    choose(above, one, t);
    const Point gap = {r.x + s * d1.x - t * d2.x, r.y + s * d1.y - t * d2.y,
                       r.z + s * d1.z - t * d2.z};
    dot(gap, gap, square);
    store(square, rows, pair);
  }

  MVS_INLINE static void farthest(DistanceBatch &rows, uint32_t pair, uint32_t split) {
    Value most = {}, square;
    for (uint32_t i = 0; i < split; ++i) {
      Point a, b, difference;
      load(rows, i, pair, a);
      for (uint32_t j = split; j < 4; ++j) {
        load(rows, j, pair, b);
        subtract(a, b, difference);
        dot(difference, difference, square);
        most = most < square ? square : most;
      }
    }
    store(most, rows, pair);
  }
};

struct Kernels {
  void (*triangles)(DistanceBatch &, uint32_t);
  void (*segments)(DistanceBatch &, uint32_t);
  void (*farthest)(DistanceBatch &, uint32_t, uint32_t);
};

// The loops compiled for a target with V its vectors. Attributes cannot be in parentheses.
// NOLINTBEGIN(bugprone-macro-parentheses)
#define MVS_KERNELS(Name, ATTRIBUTE)                                                           \
  template <typename V>                                                                        \
  struct Name {                                                                                \
    ATTRIBUTE static void triangles(DistanceBatch &rows, uint32_t count) {                     \
      for (uint32_t pair = 0; pair < count; pair += V::lanes) Kernel<V>::triangle(rows, pair); \
    }                                                                                          \
    ATTRIBUTE static void segments(DistanceBatch &rows, uint32_t count) {                      \
      for (uint32_t pair = 0; pair < count; pair += V::lanes) Kernel<V>::segments(rows, pair); \
    }                                                                                          \
    ATTRIBUTE static void farthest(DistanceBatch &rows, uint32_t count, uint32_t split) {      \
      for (uint32_t pair = 0; pair < count; pair += V::lanes) {                                \
        if (split == 1) {                                                                      \
          Kernel<V>::farthest(rows, pair, 1);                                                  \
        } else {                                                                               \
          Kernel<V>::farthest(rows, pair, 2);                                                  \
        }                                                                                      \
      }                                                                                        \
    }                                                                                          \
    static Kernels all() { return {&triangles, &segments, &farthest}; }                        \
  }

// NOLINTEND(bugprone-macro-parentheses)

MVS_KERNELS(Plain, );
#if defined(__x86_64__) && defined(__GNUC__)
MVS_KERNELS(Wider, [[gnu::target("avx2")]]);
#endif

Kernels choose() {
#if defined(__x86_64__) && defined(__GNUC__)
  if (simd_level() >= SimdLevel::avx2) return Wider<Four>::all();
#endif
  return Plain<Two>::all();
}

const Kernels &kernels() {
  static const Kernels chosen = choose();
  return chosen;
}

}  // namespace

void measure_triangles(DistanceBatch &rows, uint32_t count) {
  kernels().triangles(rows, count);
}

void measure_segments(DistanceBatch &rows, uint32_t count) {
  kernels().segments(rows, count);
}

void measure_farthest(DistanceBatch &rows, uint32_t count, uint32_t split) {
  kernels().farthest(rows, count, split);
}

}  // namespace mvs::core
