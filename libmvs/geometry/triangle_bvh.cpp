// Boxes of triangles, and the closest point of a surface.
#include "geometry/triangle_bvh.h"

#include <utility>

namespace mvs::core {
namespace {

constexpr uint32_t triangles_in_leaf = 4;

}  // namespace

BoxedTriangles::BoxedTriangles(const std::vector<Tri> &triangles, const std::vector<Vec3> &x)
    : triangles_(triangles), x_(x) {
  box_.reserve(triangles.size());
  for (const Tri &t : triangles) box_.push_back(aabb_of(x, t));
}

TriangleBvh::TriangleBvh(const std::vector<Tri> &triangles, const std::vector<Vec3> &x)
    : TriangleBvh(triangles, x, BvhTopology(x, triangles, triangles_in_leaf)) {}

TriangleBvh::TriangleBvh(const std::vector<Tri> &triangles, const std::vector<Vec3> &x,
                         BvhTopology topology_of_triangles)
    : BoxedTriangles(triangles, x), bvh_(std::move(topology_of_triangles)) {
  const BvhTopology &topology = bvh_.topology();
  bvh_.refit([&](uint32_t leaf, Aabb &volume) {
    for (uint32_t k = topology.leaf_start[leaf]; k < topology.leaf_start[leaf + 1]; ++k) {
      volume.add(box_of(topology.order[k]));
    }
  });
}

TriangleBvh::Hit TriangleBvh::closest(const Vec3 &p, uint32_t hint) const {
  ClosestSoFar best(*this, p);
  if (hint != none) best.look_at(hint);
  visit_near(p, best.distance2(), [&](uint32_t t) { best.look_at(t); });
  return best.hit();
}

bool TriangleBvh::is_within(const Vec3 &p, double distance) const {
  double limit2 = distance * distance;
  bool found = false;
  visit_near(p, limit2, [&](uint32_t t) {
    if (found || box_of(t).distance2(p) >= limit2 || closest_on(t, p).distance2 >= limit2) return;
    found = true;
    limit2 = 0;
  });
  return found;
}

}  // namespace mvs::core
