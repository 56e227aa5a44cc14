// One kernel over vector types: the nearest point by the cases of closest_on_triangle()
// (geometry/distance.h), selected by masks, then the ramps of FacingWeight. Sums are in the order
// (x + y) + z.
#include "measure/coaptation/facing_batch.h"

#include <cmath>
#include <cstring>

namespace mvs::core {
namespace {

template <typename V>
struct FacingKernel {
  using Value = typename V::Value;
  using Mask = typename V::Mask;
  struct Point {
    Value x, y, z;
  };

  MVS_INLINE static void less(const Point &p, const Vec3 &q, Point &difference) {
    difference.x = p.x - q[0];
    difference.y = p.y - q[1];
    difference.z = p.z - q[2];
  }
  MVS_INLINE static void dot(const Point &p, const Vec3 &q, Value &sum) {
    sum = (p.x * q[0] + p.y * q[1]) + p.z * q[2];
  }
  MVS_INLINE static void square(const Point &p, Value &sum) {
    sum = (p.x * p.x + p.y * p.y) + p.z * p.z;
  }
  // The squared length of p - s * d.
  MVS_INLINE static void along(const Point &p, const Value &s, const Vec3 &d, Value &sum) {
    const Point rest = {p.x - s * d[0], p.y - s * d[1], p.z - s * d[2]};
    square(rest, sum);
  }

  MVS_INLINE static void outside(const Value &at, double low, double high, Value &off) {
    const Value zero = {}, below = low - at, above = at - high;
    off = below > zero ? below : (above > zero ? above : zero);
  }
  // The squared distance of the points to a box.
  MVS_INLINE static void to_box(const Point &p, const Aabb &box, Value &sum) {
    Value x, y, z;
    outside(p.x, box.low[0], box.high[0], x);
    outside(p.y, box.low[1], box.high[1], y);
    outside(p.z, box.low[2], box.high[2], z);
    sum = (x * x + y * y) + z * z;
  }

  // Barycentric weights of the nearest point, and its squared distance.
  struct Nearest {
    Value u, v, w, distance2;
  };
  MVS_INLINE static void choose(const Mask &where, const Nearest &value, Nearest &otherwise) {
    otherwise.u = where ? value.u : otherwise.u;
    otherwise.v = where ? value.v : otherwise.v;
    otherwise.w = where ? value.w : otherwise.w;
    otherwise.distance2 = where ? value.distance2 : otherwise.distance2;
  }

  // Cases from the last to the first, which overrides the others.
  MVS_INLINE static void nearest(const Point &p, const std::array<Vec3, 3> &corner,
                                 Nearest &found) {
    const Vec3 &a = corner[0], &b = corner[1], &c = corner[2];
    const Vec3 ab = b - a, ac = c - a, bc = c - b;
    Point ap, bp, cp;
    less(p, a, ap);
    less(p, b, bp);
    less(p, c, cp);
    Value d1, d2, d3, d4, d5, d6;
    dot(ap, ab, d1);
    dot(ap, ac, d2);
    dot(bp, ab, d3);
    dot(bp, ac, d4);
    dot(cp, ab, d5);
    dot(cp, ac, d6);
    const Value zero = {}, one = zero + 1;
    const Value vc = d1 * d4 - d3 * d2, vb = d5 * d2 - d1 * d6, va = d3 * d6 - d5 * d4;
    const Value scale = one / (va + vb + vc);
    found.v = vb * scale;
    found.w = vc * scale;
    found.u = one - found.v - found.w;
    const Point flat = {ap.x - found.v * ab[0] - found.w * ac[0],
                        ap.y - found.v * ab[1] - found.w * ac[1],
                        ap.z - found.v * ab[2] - found.w * ac[2]};
    square(flat, found.distance2);
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
    square(cp, other.distance2);
    choose((d6 >= zero) & (d5 <= d6), other, found);
    s = d1 > d3 ? d1 / (d1 - d3) : zero;
    other = {one - s, s, zero, zero};
    along(ap, s, ab, other.distance2);
    choose((vc <= zero) & (d1 >= zero) & (d3 <= zero), other, found);
    other = {zero, one, zero, zero};
    square(bp, other.distance2);
    choose((d3 >= zero) & (d4 <= d3), other, found);
    other = {one, zero, zero, zero};
    square(ap, other.distance2);
    choose((d1 <= zero) & (d2 <= zero), other, found);
  }

  // The product of all ramps but that of the distance itself and of the normals.
  MVS_INLINE static void weigh_directions(const Point &p, const Point &q, const Value &distance,
                                          const Vec3 &normal, const FacingTriangle &triangle,
                                          double reach, Value &weight) {
    const Point to = {p.x - q.x, p.y - q.y, p.z - q.z};
    Value along_normal, direction, contact;
    dot(to, normal, along_normal);
    fall<Value>(along_normal / distance, direction_ramp, direction);
    fall<Value>(distance / reach, contact_ramp, contact);
    const Value sided = weight * (1 - (1 - direction) * (1 - contact));
    weight = distance > contact_ramp.from * reach ? sided : weight;
    const Value least = Value{} + nearest_share * reach;
    for (const FacingBorder &border : triangle.borders) {
      Point from;
      Value height, out, inside;
      less(p, border.from, from);
      dot(from, triangle.normal, height);
      dot(from, border.out, out);
      height = height < least ? least : height;
      fall<Value>((out - border.beyond) / height, border_ramp, inside);
      weight = weight * inside;
    }
  }

  // Whether any element of a mask is set.
  MVS_INLINE static bool any(const Mask &mask) {
    int64_t element[V::width], set = 0;
    std::memcpy(element, &mask, sizeof element);
    for (const int64_t e : element) set |= e;
    return set != 0;
  }

  // The points from `first` on that one register holds; returns whether one has a weight.
  MVS_INLINE static bool run(const FacingPoints &points, const Vec3 &normal,
                             const FacingTriangle &triangle, double reach, size_t first,
                             FacingWeights &weights) {
    const double limit = distance_ramp.to * reach;
    const Value zero = {}, limit2 = zero + limit * limit;
    Point p;
    load<V>(p.x, &points.x[first]);
    load<V>(p.y, &points.y[first]);
    load<V>(p.z, &points.z[first]);
    Value box2;
    to_box(p, triangle.box, box2);
    store<V>(&weights.weight[first], zero);
    if (!any(box2 < limit2)) return false;
    Nearest found;
    nearest(p, triangle.corner, found);
    const std::array<Vec3, 3> &c = triangle.corner;
    const Point q = {found.u * c[0][0] + found.v * c[1][0] + found.w * c[2][0],
                     found.u * c[0][1] + found.v * c[1][1] + found.w * c[2][1],
                     found.u * c[0][2] + found.v * c[1][2] + found.w * c[2][2]};
    double root[V::width];
    store<V>(root, found.distance2);
    for (double &r : root) r = std::sqrt(r);
    Value distance, weight;
    load<V>(distance, root);
    fall<Value>(distance / reach, distance_ramp, weight);
    weight = weight * triangle.normals;
    weigh_directions(p, q, distance, normal, triangle, reach, weight);
    const Mask is_near = (box2 < limit2) & (found.distance2 < limit2);
    weight = is_near ? weight : zero;
    store<V>(&weights.weight[first], weight);
    store<V>(&weights.distance2[first], found.distance2);
    store<V>(&weights.x[first], q.x);
    store<V>(&weights.y[first], q.y);
    store<V>(&weights.z[first], q.z);
    return any(weight > zero);
  }
};

template <typename V>
MVS_INLINE bool weigh_all(const FacingPoints &points, const Vec3 &normal,
                          const FacingTriangle &triangle, double reach, FacingWeights &weights) {
  bool found = false;
  for (size_t first = 0; first < points.count; first += V::width) {
    found |= FacingKernel<V>::run(points, normal, triangle, reach, first, weights);
  }
  return found;
}

}  // namespace

bool weigh_points(const FacingPoints &points, const Vec3 &normal, const FacingTriangle &triangle,
                  double reach, FacingWeights &weights) {
  static const auto kernel =
      simd_kernel<&weigh_all<Double2>, &weigh_all<Double4>, &weigh_all<Double8>>();
  return kernel(points, normal, triangle, reach, weights);
}

}  // namespace mvs::core
