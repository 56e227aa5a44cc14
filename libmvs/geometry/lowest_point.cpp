// Half-spaces are added one after the other: where the point lies outside of a new one, the lowest
// point is on its plane, which is the same problem in two dimensions, then in one.
#include "geometry/lowest_point.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

namespace mvs::core {
namespace {

// Rounding of scalar products of unit vectors with lengths of `reach`, as a share of these.
constexpr double rounding_of_products = 1e-14;

// The points (s, t) of a plane with a s + b t >= c.
struct HalfPlane {
  double a, b, c;
};

struct Point2 {
  double s, t;
};

// The point with the largest s on the border of half-plane `on`, within those before it. False if
// no point of the border is in all of them.
bool furthest_on_line(const std::vector<HalfPlane> &planes, size_t on, double reach,
                      Point2 &point) {
  const HalfPlane &line = planes[on];
  const double length2 = line.a * line.a + line.b * line.b;
  const Point2 foot{line.a * line.c / length2, line.b * line.c / length2};
  const double length = std::sqrt(length2);
  // along the line, s does not fall
  const double sign = line.b > 0 ? -1 : 1;
  const Point2 along{-sign * line.b / length, sign * line.a / length};
  double low = -8 * reach, high = 8 * reach;
  for (size_t k = 0; k < on; ++k) {
    const double slope = planes[k].a * along.s + planes[k].b * along.t;
    const double lack = planes[k].c - (planes[k].a * foot.s + planes[k].b * foot.t);
    if (std::abs(slope) <= rounding_of_products) {
      if (lack > rounding_of_products * reach) return false;
    } else if (slope > 0) {
      low = std::max(low, lack / slope);
    } else {
      high = std::min(high, lack / slope);
    }
  }
  if (low > high + rounding_of_products * reach) return false;
  // a line across s: all its points are as far, and the one nearest to the foot is taken
  const double place =
      along.s > rounding_of_products ? high : std::clamp(0.0, low, std::max(low, high));
  point = {foot.s + place * along.s, foot.t + place * along.t};
  return true;
}

// The lowest point on the border of half-space `on` within those before it and a cube.
// `planes` is overwritten.
bool find_on_plane(const std::vector<HalfSpace> &spaces, size_t on, double reach,
                   std::vector<HalfPlane> &planes, Vec3 &point) {
  const HalfSpace &plane = spaces[on];
  const Vec3 foot = plane.offset * plane.normal;
  // downwards on the plane, without cancellation where it is almost horizontal
  const Vec3 &n = plane.normal;
  const double steep = std::sqrt(n[0] * n[0] + n[1] * n[1]);
  // any direction of a horizontal plane: all its points are as low
  const Vec3 along = steep > rounding_of_products
                         ? Vec3(n[2] * n[0] / steep, n[2] * n[1] / steep, -steep)
                         : Vec3(1, 0, 0);
  const Vec3 across = plane.normal.cross(along);
  planes.clear();
  const auto add = [&](const Vec3 &normal, double offset) {
    planes.push_back({normal.dot(along), normal.dot(across), offset - normal.dot(foot)});
  };
  for (int axis = 0; axis < 3; ++axis) {
    add(Vec3::Unit(axis), -reach);
    add(-Vec3::Unit(axis), -reach);
  }
  for (size_t k = 0; k < on; ++k) add(spaces[k].normal, spaces[k].offset);
  Point2 best{steep > rounding_of_products ? 4 * reach : 0, 0};
  for (size_t k = 0; k < planes.size(); ++k) {
    const HalfPlane &h = planes[k];
    const double lack = h.c - (h.a * best.s + h.b * best.t);
    if (lack <= rounding_of_products * reach) continue;
    if (h.a * h.a + h.b * h.b <= rounding_of_products * rounding_of_products) return false;
    if (!furthest_on_line(planes, k, reach, best)) return false;
  }
  point = foot + best.s * along + best.t * across;
  return true;
}

}  // namespace

Vec3 lowest_point(const std::vector<HalfSpace> &half_spaces, double reach) {
  Vec3 point(0, 0, -reach);
  std::vector<HalfPlane> planes;
  for (size_t k = 0; k < half_spaces.size(); ++k) {
    const HalfSpace &h = half_spaces[k];
    if (h.normal.dot(point) >= h.offset - rounding_of_products * reach) continue;
    if (!find_on_plane(half_spaces, k, reach, planes, point)) return Vec3::Zero();
  }
  return point;
}

}  // namespace mvs::core
