// Boxes in single precision, with a margin above its rounding, rule out; doubles decide.
#include "measure/orifice/opposite.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "geometry/bvh.h"
#include "geometry/simd_points.h"

namespace mvs::core::orifice {
namespace {

constexpr size_t row = 8;        // boxes
constexpr uint32_t members = 4;  // triangles of a group
constexpr double of_cosine = 2;  // 1 / cos(60 degrees)
// Added to half of each box, as a share of the largest coordinate: 20 roundings of single
// precision.
constexpr double margin = 20 * 6e-8;
// Share of a distance from p: far above the rounding of doubles where the distance is at least a
// thousandth of the limit, since coordinates are less than a million limits.
constexpr double distance_rounding = 1e-6;

// A query in single precision.
struct BoxFilter {
  float p[3], normal[3], out[3], distance2;
};

// Bit k is set if box first + k may have opposite tissue. A point of the box at distance d counts
// only if its component along a direction is above d cos(60 degrees); d is at least that of the
// box, and the component at most that of its furthest corner.
template <typename V>
MVS_INLINE uint32_t filter_boxes(const BoxFilter &filter, const Opposite::Boxes &boxes,
                                 size_t first) {
  using Value = typename V::Value;
  Value square = {}, up = {}, out = {}, up_half = {}, out_half = {};
  for (size_t c = 0; c < 3; ++c) {
    Value v, half, length;
    load<V>(v, &boxes.centre[c][first]);
    load<V>(half, &boxes.half[c][first]);
    v = v - filter.p[c];
    up = up + v * filter.normal[c];
    out = out + v * filter.out[c];
    up_half = up_half + half * std::abs(filter.normal[c]);
    out_half = out_half + half * std::abs(filter.out[c]);
    magnitude_of<Value>(v, length);
    length = length - half;
    length = length > 0 ? length : Value{};
    square = square + length * length;
  }
  magnitude_of<Value>(up, up);
  up = up + up_half;
  out = out + out_half;
  const Value most = static_cast<float>(of_cosine) * (up < out ? out : up);
  return bits_of<V>((square < filter.distance2) & (square < most * most));
}

// The eight boxes from `first` on.
template <typename V>
MVS_INLINE uint32_t filter_row(const BoxFilter &filter, const Opposite::Boxes &boxes,
                               size_t first) {
  uint32_t bits = 0;
  for (size_t k = 0; k < row; k += V::width) {
    bits |= filter_boxes<V>(filter, boxes, first + k) << k;
  }
  return bits;
}

// Triangles with a nearest point that may count, found from the corners, seen from p, alone. The
// nearest point lies between them: its components along the directions are at most their largest
// ones, and its distance at least their least component towards their middle.
template <typename V>
MVS_INLINE uint32_t may_count(const typename SimdPoints<V>::Point (&corner)[3],
                              const typename SimdPoints<V>::Point &normal,
                              const typename SimdPoints<V>::Point &out, double limit2) {
  using Value = typename V::Value;
  using Points = SimdPoints<V>;
  const typename Points::Point middle = {corner[0].x + corner[1].x + corner[2].x,
                                         corner[0].y + corner[1].y + corner[2].y,
                                         corner[0].z + corner[1].z + corner[2].z};
  Value most = {}, least, square;
  Points::dot(middle, middle, square);
  for (size_t k = 0; k < 3; ++k) {
    Value up, beyond, ahead;
    Points::dot(corner[k], normal, up);
    Points::dot(corner[k], out, beyond);
    Points::dot(corner[k], middle, ahead);
    magnitude_of<Value>(up, up);
    most = most < up ? up : most;
    most = most < beyond ? beyond : most;
    if (k == 0) least = ahead;
    least = ahead < least ? ahead : least;
  }
  const Value zero = {}, least2 = (1 - distance_rounding) * (least * least);
  const auto is_out = (least > zero) & ((of_cosine * of_cosine * (most * most) * square < least2) |
                                        (limit2 * square < least2));
  return ~bits_of_doubles<V>(is_out) & ((1u << V::width) - 1);
}

// Whether a triangle of the group has its nearest point in one of the directions. The triangle on
// which p lies does not count: the direction to it is rounding error.
template <typename V>
MVS_INLINE uint32_t look_at_group(const OppositeQuery &query, double limit2,
                                  const Opposite::Group &group) {
  using Value = typename V::Value;
  using Points = SimdPoints<V>;
  uint32_t found = 0;
  const Value zero = {};
  const typename Points::Point p = {zero + query.p[0], zero + query.p[1], zero + query.p[2]};
  const typename Points::Point normal = {zero + query.normal[0], zero + query.normal[1],
                                         zero + query.normal[2]};
  const typename Points::Point out = {zero + query.out[0], zero + query.out[1],
                                      zero + query.out[2]};
  for (size_t first = 0; first < members; first += V::width) {
    typename Points::Point corner[3], seen[3], to;
    for (size_t k = 0; k < 3; ++k) {
      load<V>(corner[k].x, &group.at[k][0][first]);
      load<V>(corner[k].y, &group.at[k][1][first]);
      load<V>(corner[k].z, &group.at[k][2][first]);
      Points::subtract(corner[k], p, seen[k]);
    }
    if (may_count<V>(seen, normal, out, limit2) == 0) continue;
    typename Points::Nearest hit;
    Points::nearest(p, corner[0], corner[1], corner[2], hit);
    to.x = hit.u * corner[0].x + hit.v * corner[1].x + hit.w * corner[2].x - p.x;
    to.y = hit.u * corner[0].y + hit.v * corner[1].y + hit.w * corner[2].y - p.y;
    to.z = hit.u * corner[0].z + hit.v * corner[1].z + hit.w * corner[2].z - p.z;
    Value up, beyond;
    Points::dot(to, normal, up);
    Points::dot(to, out, beyond);
    const Value height = up < -up ? -up : up;
    const Value most = of_cosine * (height < beyond ? beyond : height);
    const auto counts = (hit.distance2 < zero + limit2) & (hit.distance2 > zero + 1e-6 * limit2) &
                        (most * most > hit.distance2);
    for (size_t k = 0; k < V::width; ++k) {
      int64_t element;
      std::memcpy(&element, reinterpret_cast<const char *>(&counts) + sizeof element * k,
                  sizeof element);
      found |= element != 0;
    }
  }
  return found;
}

}  // namespace

void Opposite::Boxes::add(const Aabb &box, double wider) {
  for (int c = 0; c < 3; ++c) {
    centre[c].push_back(static_cast<float>(0.5 * (box.low[c] + box.high[c])));
    half[c].push_back(static_cast<float>(0.5 * (box.high[c] - box.low[c]) + wider));
  }
}

// Fills the last row up with boxes that are nowhere near.
void Opposite::Boxes::fill_row() {
  while (size() % row != 0) add({Vec3::Constant(1e9), Vec3::Constant(1e9)}, 0);
}

Opposite::Opposite(const std::vector<Tri> &triangles, const std::vector<Vec3> &x) {
  const BvhTopology topology(x, triangles, members);
  groups_.resize(topology.leaf_count());
  double largest = 0;
  for (const Vec3 &p : x) largest = std::max(largest, p.cwiseAbs().maxCoeff());
  Aabb box_of_row;
  for (uint32_t leaf = 0; leaf < topology.leaf_count(); ++leaf) {
    const uint32_t first = topology.leaf_start[leaf], last = topology.leaf_start[leaf + 1];
    Aabb box;
    for (uint32_t i = 0; i < members; ++i) {
      // the last group may be smaller: it repeats a triangle
      const Tri &t = triangles[topology.order[std::min(first + i, last - 1)]];
      box.add(aabb_of(x, t));
      for (size_t k = 0; k < 3; ++k) {
        for (int c = 0; c < 3; ++c) groups_[leaf].at[k][c][i] = x[t[k]][c];
      }
    }
    boxes_.add(box, margin * largest);
    box_of_row.add(box);
    if ((leaf + 1) % row != 0 && leaf + 1 < topology.leaf_count()) continue;
    rows_.add(box_of_row, margin * largest);
    box_of_row = {};
  }
  boxes_.fill_row();
  rows_.fill_row();
}

bool Opposite::is_within(const OppositeQuery &query, double distance) const {
  static const auto filter_kernel = simd_kernel<&filter_row<Float4>, &filter_row<Float8>>();
  static const auto kernel = simd_kernel<&look_at_group<Double2>, &look_at_group<Double4>>();
  BoxFilter filter;
  for (int c = 0; c < 3; ++c) {
    filter.p[c] = static_cast<float>(query.p[c]);
    filter.normal[c] = static_cast<float>(query.normal[c]);
    filter.out[c] = static_cast<float>(query.out[c]);
  }
  filter.distance2 = static_cast<float>(distance * distance * (1 + margin));
  // calls visit(k) for boxes of a row until it returns true
  const auto any_of_row = [&](const Boxes &boxes, size_t first, auto &&visit) {
    for (unsigned bits = filter_kernel(filter, boxes, first); bits != 0; bits &= bits - 1) {
      if (visit(first + static_cast<size_t>(std::countr_zero(bits)))) return true;
    }
    return false;
  };
  for (size_t first = 0; first < rows_.size(); first += row) {
    const bool found = any_of_row(rows_, first, [&](size_t r) {
      return any_of_row(boxes_, row * r, [&](size_t group) {
        return kernel(query, distance * distance, groups_[group]) != 0;
      });
    });
    if (found) return true;
  }
  return false;
}

}  // namespace mvs::core::orifice
