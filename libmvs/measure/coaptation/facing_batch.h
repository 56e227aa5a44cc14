// Weights with which many points of one triangle face another triangle, by SIMD.
#pragma once

#include <array>

#include "base/simd.h"
#include "geometry/aabb.h"

namespace mvs::core {

// A ramp falls from 1 at its first value to 0 at its second. Their middles are the thresholds of
// FacingSurface.
struct Ramp {
  double from, to;
};
inline constexpr Ramp distance_ramp = {0.85, 1.15};   // over reach
inline constexpr Ramp normals_ramp = {-0.6, -0.4};    // cosine between the normals
inline constexpr Ramp direction_ramp = {-0.6, -0.4};  // minus cosine of normal and direction
inline constexpr Ramp border_ramp = {0.176, 0.364};   // tangents of 10 and 20 degrees
inline constexpr Ramp contact_ramp = {0.05,
                                      0.15};  // share of reach: below, directions do not count
inline constexpr double nearest_share = 0.1;  // of reach: rounds off which tissue is nearest

// 1 before the ramp, 0 behind it, a cubic between. Of a number or of a vector of them.
template <typename Value>
MVS_INLINE void fall(const Value &value, const Ramp &ramp, Value &weight) {
  const Value zero = {}, one = zero + 1;
  const Value share = (value - ramp.from) / (ramp.to - ramp.from);
  const Value s = share < zero ? zero : (one < share ? one : share);
  weight = 1 - s * s * (3 - 2 * s);
}

// Points as a structure of arrays. At most as many as a triangle has parts for coaptation, rounded
// up to full registers.
struct FacingPoints {
  static constexpr size_t most = 152;
  using Row = std::array<double, most>;

  size_t count = 0;
  Row x{}, y{}, z{};

  void add(const Vec3 &p) {
    x[count] = p[0];
    y[count] = p[1];
    z[count++] = p[2];
  }
};

// A half-plane that bounds a triangle at the border of the sheet.
struct FacingBorder {
  Vec3 from, out;  // unit, in the plane of the triangle
  double beyond;   // m, how far the triangle reaches out itself
};

// A half-space: outside where out.dot(p) > beyond.
struct HalfSpace {
  Vec3 out = Vec3::Zero();  // unit, or zero: all of space
  double beyond = 0;
};

// The box of a triangle, its plane, and the half-spaces at its sides: they contain it.
struct FacingBounds {
  Aabb box;
  HalfSpace plane;
  std::array<HalfSpace, 3> side;
};
FacingBounds bounds_of(const std::array<Vec3, 3> &corner, const Vec3 &normal, const Aabb &box);

// Sets near[k] to the bits of the points 4 k to 4 k + 3 that may be nearer to a triangle than the
// root of `limit2`.
using NearFours = std::array<uint8_t, FacingPoints::most / 4>;
void mark_near(const FacingBounds &bounds, const FacingPoints &points, double limit2,
               NearFours &near);

// Points, each with a triangle that it may face, as a structure of arrays: one register holds pairs
// of different triangles.
struct FacingPairs {
  static constexpr size_t most = 256;
  using Row = std::array<double, most>;
  struct Points {
    Row x{}, y{}, z{};
    void set(size_t k, const Vec3 &point) {
      x[k] = point[0];
      y[k] = point[1];
      z[k] = point[2];
    }
  };

  size_t count = 0;
  Points p, a, b, c;  // the point, and the corners of the triangle
  Row normals{};      // weight of the angle between the normals of both triangles
  // Weight without borders, squared distance to the triangle and its nearest point.
  Row weight{}, distance2{};
  Points nearest;
};

// Weighs the pairs of points of one triangle, which has this normal.
void weigh_pairs(const Vec3 &normal, double reach, FacingPairs &pairs);

}  // namespace mvs::core
