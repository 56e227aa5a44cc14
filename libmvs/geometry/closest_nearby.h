// Closest points of a surface to many points that lie near each other: the triangles that can be
// closest to any of them are collected once.
#pragma once

#include <vector>

#include "geometry/triangle_bvh.h"

namespace mvs::core {

// The squared distance from the centre of a ball within which the closest triangle of each of its
// points lies, above rounding; `distance2` is that of the triangle closest to the centre. If the
// surface is at distance d from the centre, it is within d + r of a point of the ball, so that the
// closest triangle of any point is within d + 2 r of the centre.
double nearby_limit2(double distance2, double radius);

// A triangle, and its squared distance from the centre of a ball.
struct NearTriangle {
  uint32_t triangle;
  double distance2;
};

// Lists those of some triangles that can be closest to a point of a ball, in their order. Returns
// the one closest to the centre, of equally close ones that with the lowest number; `none` without
// triangles.
uint32_t list_nearby(const TriangleBvh &tree, const std::vector<uint32_t> &among,
                     const Vec3 &centre, double radius, std::vector<NearTriangle> &near);

// For points within a ball.
class ClosestNearby {
 public:
  // `hint`: a triangle that may be close to the centre, or `none`. Keeps a reference to the tree.
  ClosestNearby(const TriangleBvh &tree, const Vec3 &centre, double radius, uint32_t hint);

  // The same as TriangleBvh::closest, for a point in the ball.
  TriangleBvh::Hit closest(const Vec3 &p, uint32_t hint = none) const;
  // The triangle closest to the centre; `none` without triangles.
  uint32_t closest_to_centre() const { return first_; }
  // Every triangle that can be closest to a point of the ball.
  const std::vector<uint32_t> &triangles() const { return triangles_; }

 private:
  const TriangleBvh &tree_;
  uint32_t first_;
  std::vector<uint32_t> triangles_;
};

}  // namespace mvs::core
