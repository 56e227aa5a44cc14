// The nearest points of the triangle, then the ramps of FacingWeight.
#include "measure/coaptation/facing_batch.h"

#include <cmath>
#include <cstring>

#include "geometry/simd_points.h"

namespace mvs::core {
namespace {

template <typename V>
struct FacingKernel : SimdPoints<V> {
  using Value = typename V::Value;
  using Mask = typename V::Mask;
  using typename SimdPoints<V>::Point;
  using SimdPoints<V>::dot, SimdPoints<V>::subtract;

  // The same point or direction in every element.
  MVS_INLINE static void spread(const Vec3 &p, Point &points) {
    points = {Value{} + p[0], Value{} + p[1], Value{} + p[2]};
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

  // The product of all ramps but that of the distance itself and of the normals.
  MVS_INLINE static void weigh_directions(const Point &p, const Point &q, const Value &distance,
                                          const Vec3 &normal, const FacingTriangle &triangle,
                                          double reach, Value &weight) {
    Point to, own, other;
    subtract(p, q, to);
    spread(normal, own);
    spread(triangle.normal, other);
    Value along_normal, direction, contact;
    dot(to, own, along_normal);
    fall<Value>(along_normal / distance, direction_ramp, direction);
    fall<Value>(distance / reach, contact_ramp, contact);
    const Value sided = weight * (1 - (1 - direction) * (1 - contact));
    weight = distance > contact_ramp.from * reach ? sided : weight;
    const Value least = Value{} + nearest_share * reach;
    for (const FacingBorder &border : triangle.borders) {
      Point start, outwards, from;
      Value height, out, inside;
      spread(border.from, start);
      spread(border.out, outwards);
      subtract(p, start, from);
      dot(from, other, height);
      dot(from, outwards, out);
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
    Point a, b, c;
    spread(triangle.corner[0], a);
    spread(triangle.corner[1], b);
    spread(triangle.corner[2], c);
    typename SimdPoints<V>::Nearest found;
    SimdPoints<V>::nearest(p, a, b, c, found);
    const Point q = {found.u * a.x + found.v * b.x + found.w * c.x,
                     found.u * a.y + found.v * b.y + found.w * c.y,
                     found.u * a.z + found.v * b.z + found.w * c.z};
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
