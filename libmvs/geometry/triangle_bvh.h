// Bounding volume hierarchy of a surface at rest: triangles whose boxes overlap a box, triangles
// nearest to a point, pairs of triangles near each other.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "base/types.h"
#include "geometry/aabb.h"
#include "geometry/bvh.h"
#include "geometry/distance.h"

namespace mvs::core {

// The triangles, with their boxes.
class BoxedTriangles {
 public:
  // Keeps references to both.
  BoxedTriangles(const std::vector<Tri> &triangles, const std::vector<Vec3> &x);

  const Aabb &box_of(uint32_t triangle) const { return box_[triangle]; }
  TrianglePoint closest_on(uint32_t triangle, const Vec3 &p) const {
    const Tri &t = triangles_[triangle];
    return closest_on_triangle(p, x_[t[0]], x_[t[1]], x_[t[2]]);
  }
  Vec3 point_at(uint32_t triangle, const std::array<double, 3> &weight) const {
    const Tri &t = triangles_[triangle];
    return weight[0] * x_[t[0]] + weight[1] * x_[t[1]] + weight[2] * x_[t[2]];
  }

 private:
  const std::vector<Tri> &triangles_;
  const std::vector<Vec3> &x_;
  std::vector<Aabb> box_;
};

// The hierarchy over them.
class TriangleBvh : public BoxedTriangles {
 public:
  // Keeps references to both: they must outlive the hierarchy.
  TriangleBvh(const std::vector<Tri> &triangles, const std::vector<Vec3> &x);
  // The same with the topology of these triangles at other positions: the results do not depend on
  // the topology.
  TriangleBvh(const std::vector<Tri> &triangles, const std::vector<Vec3> &x, BvhTopology topology);

  // Calls visit(triangle) for every triangle whose box overlaps `box`.
  template <typename Visit>
  void for_overlapping(const Aabb &box, Visit &&visit) const {
    bvh_.for_overlapping([&](const Aabb &volume) { return !volume.overlaps(box); },
                         [&](uint32_t t) {
                           if (box_of(t).overlaps(box)) visit(t);
                         });
  }
  // Calls visit(a, b) once for at least every pair of triangles whose boxes are no further apart
  // than sqrt(limit2); the visitor looks at the boxes itself.
  template <typename Visit>
  void for_near_pairs(double limit2, Visit &&visit) const {
    bvh_.for_near_triangles([&](const Aabb &a, const Aabb &b) { return a.distance2(b) > limit2; },
                            visit);
  }

  // Calls visit(triangle) for at least every triangle nearer to p than sqrt(limit2), near boxes
  // first; the visitor may lower limit2, which it holds by reference.
  template <typename Visit>
  void visit_near(const Vec3 &p, const double &limit2, Visit &&visit) const {
    bvh_.for_nearest([&](const Aabb &volume) { return volume.distance2(p); }, limit2, visit);
  }

  // The closest point of all triangles; on equal distance, that of the first triangle.
  struct Hit {
    uint32_t triangle = none;
    double distance2 = 0;
    Vec3 point;
  };
  // `hint`: a triangle that may be close, or `none`; it saves time and changes nothing else.
  Hit closest(const Vec3 &p, uint32_t hint = none) const;
  // Whether a triangle is nearer to p than a distance in m.
  bool is_within(const Vec3 &p, double distance) const;

 private:
  Bvh<Aabb> bvh_;
};

// The closest point to p of the triangles looked at so far; on equal distance, that of the first
// triangle.
class ClosestSoFar {
 public:
  // Keeps references to both.
  ClosestSoFar(const BoxedTriangles &triangles, const Vec3 &p) : triangles_(triangles), p_(p) {}

  void look_at(uint32_t t) {
    if (triangles_.box_of(t).distance2(p_) > distance2_) return;
    const TrianglePoint q = triangles_.closest_on(t, p_);
    const bool is_tie = q.distance2 == distance2_ && t < triangle_;
    if (!(q.distance2 < distance2_ || is_tie)) return;
    triangle_ = t;
    distance2_ = q.distance2;
    weight_ = q.weight;
  }
  // Infinite before the first triangle.
  const double &distance2() const { return distance2_; }
  TriangleBvh::Hit hit() const {
    if (triangle_ == none) return {none, distance2_, Vec3::Zero()};
    return {triangle_, distance2_, triangles_.point_at(triangle_, weight_)};
  }

 private:
  const BoxedTriangles &triangles_;
  const Vec3 &p_;
  uint32_t triangle_ = none;
  double distance2_ = std::numeric_limits<double>::infinity();
  std::array<double, 3> weight_{};
};

}  // namespace mvs::core
