// The nearest points of the triangle, then the ramps of FacingWeight.
#include "measure/coaptation/facing_batch.h"

#include <Eigen/Geometry>
#include <cmath>

#include "geometry/simd_points.h"

namespace mvs::core {
namespace {

template <typename V>
struct FacingKernel : SimdPoints<V> {
  using Value = typename V::Value;
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

  MVS_INLINE static void height_over(const Point &p, const HalfSpace &space, Value &height) {
    height = ((p.x * space.out[0] + p.y * space.out[1]) + p.z * space.out[2]) - space.beyond;
  }

  // The ramps of the distance, and of the direction unless there is contact.
  MVS_INLINE static void weigh(const Point &p, const Point &q, const Value &distance,
                               const Value &normals, const Vec3 &normal, double reach,
                               Value &weight) {
    Point to, own;
    subtract(p, q, to);
    spread(normal, own);
    Value along_normal, direction, contact;
    fall<Value>(distance / reach, distance_ramp, weight);
    weight = weight * normals;
    dot(to, own, along_normal);
    fall<Value>(along_normal / distance, direction_ramp, direction);
    fall<Value>(distance / reach, contact_ramp, contact);
    const Value sided = weight * (1 - (1 - direction) * (1 - contact));
    weight = distance > contact_ramp.from * reach ? sided : weight;
  }

  MVS_INLINE static void root_of(const Value &square, Value &root) {
    double element[V::width];
    store<V>(element, square);
    for (double &e : element) e = std::sqrt(e);
    load<V>(root, element);
  }

  MVS_INLINE static void load_points(const FacingPairs::Points &from, size_t first, Point &p) {
    load<V>(p.x, &from.x[first]);
    load<V>(p.y, &from.y[first]);
    load<V>(p.z, &from.z[first]);
  }

  // The pairs from `first` on that one register holds.
  MVS_INLINE static void run(const Vec3 &normal, double reach, size_t first, FacingPairs &pairs) {
    const double limit = distance_ramp.to * reach;
    const Value zero = {}, limit2 = zero + limit * limit;
    Point p, a, b, c;
    load_points(pairs.p, first, p);
    load_points(pairs.a, first, a);
    load_points(pairs.b, first, b);
    load_points(pairs.c, first, c);
    typename SimdPoints<V>::Nearest found;
    SimdPoints<V>::nearest(p, a, b, c, found);
    const Point q = {found.u * a.x + found.v * b.x + found.w * c.x,
                     found.u * a.y + found.v * b.y + found.w * c.y,
                     found.u * a.z + found.v * b.z + found.w * c.z};
    Value distance, normals, weight;
    root_of(found.distance2, distance);
    load<V>(normals, &pairs.normals[first]);
    weigh(p, q, distance, normals, normal, reach, weight);
    weight = found.distance2 < limit2 ? weight : zero;
    store<V>(&pairs.weight[first], weight);
    store<V>(&pairs.distance2[first], found.distance2);
    store<V>(&pairs.nearest.x[first], q.x);
    store<V>(&pairs.nearest.y[first], q.y);
    store<V>(&pairs.nearest.z[first], q.z);
  }
};

template <typename V>
MVS_INLINE void weigh_all(const Vec3 &normal, double reach, FacingPairs &pairs) {
  for (size_t first = 0; first < pairs.count; first += V::width) {
    FacingKernel<V>::run(normal, reach, first, pairs);
  }
}

// The bounds by planes have a relative rounding error far below this.
constexpr double rounding_of_planes = 1e-9;

template <typename V>
MVS_INLINE void mark_all(const FacingBounds &bounds, const FacingPoints &points, double limit2,
                         NearFours &near) {
  using Value = typename V::Value;
  const Value zero = {}, limit = zero + limit2;
  for (size_t k = 0; 4 * k < points.count; ++k) near[k] = 0;
  for (size_t first = 0; first < points.count; first += V::width) {
    typename FacingKernel<V>::Point p;
    load<V>(p.x, &points.x[first]);
    load<V>(p.y, &points.y[first]);
    load<V>(p.z, &points.z[first]);
    Value to_box, height, out, most = {};
    FacingKernel<V>::to_box(p, bounds.box, to_box);
    FacingKernel<V>::height_over(p, bounds.plane, height);
    for (const HalfSpace &side : bounds.side) {
      FacingKernel<V>::height_over(p, side, out);
      most = most < out ? out : most;
    }
    const Value to_planes = (height * height + most * most) * (1 - rounding_of_planes);
    const Value least = to_box < to_planes ? to_planes : to_box;
    near[first / 4] |= static_cast<uint8_t>(bits_of_doubles<V>(least < limit) << first % 4);
  }
}

}  // namespace

FacingBounds bounds_of(const std::array<Vec3, 3> &corner, const Vec3 &normal, const Aabb &box) {
  FacingBounds bounds;
  bounds.box = box;
  bounds.plane = {normal, normal.dot(corner[0])};
  for (size_t k = 0; k < 3; ++k) {
    const Vec3 out = (corner[(k + 1) % 3] - corner[k]).cross(normal);
    const double length = out.norm();
    if (length > 0) bounds.side[k] = {out / length, out.dot(corner[k]) / length};
  }
  return bounds;
}

void mark_near(const FacingBounds &bounds, const FacingPoints &points, double limit2,
               NearFours &near) {
  static const auto kernel = simd_kernel<&mark_all<Double2>, &mark_all<Double4>>();
  kernel(bounds, points, limit2, near);
  const size_t beyond = points.count % 4;
  if (beyond != 0) near[points.count / 4] &= static_cast<uint8_t>((1u << beyond) - 1);
}

void weigh_pairs(const Vec3 &normal, double reach, FacingPairs &pairs) {
  // gcc selects elements of 512 bits one by one: AVX-512 takes a third longer than AVX2
  static const auto kernel = simd_kernel<&weigh_all<Double2>, &weigh_all<Double4>>();
  kernel(normal, reach, pairs);
}

}  // namespace mvs::core
