// Construction of the hierarchy by median splits, and the closest point of a surface.
#include "geometry/bvh.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

namespace mvs::core {
namespace {

constexpr uint32_t triangles_in_leaf = 4;  // of a TriangleBvh

struct BvhBuilder {
  BvhTopology &bvh;
  std::vector<Vec3> centre;  // three times the centroid of each triangle
  uint32_t leaf_size;

  // Appends the subtree over order[first] to order[last - 1] and returns its root.
  uint32_t build(uint32_t first, uint32_t last) {
    const auto self = static_cast<uint32_t>(bvh.nodes.size());
    bvh.nodes.push_back({none, self + 1, static_cast<uint32_t>(bvh.leaf_start.size())});
    if (last - first <= leaf_size) {
      bvh.leaf_start.push_back(first);
      return self;
    }
    Aabb box;
    for (uint32_t k = first; k < last; ++k) box.add(centre[bvh.order[k]]);
    Eigen::Index axis;
    (box.high - box.low).maxCoeff(&axis);
    const uint32_t leaves = (last - first + leaf_size - 1) / leaf_size;
    const uint32_t middle = first + (leaves + 1) / 2 * leaf_size;
    const auto begin = bvh.order.begin();
    std::nth_element(begin + first, begin + middle, begin + last, [&](uint32_t a, uint32_t b) {
      return std::pair(centre[a][axis], a) < std::pair(centre[b][axis], b);
    });
    build(first, middle);
    const uint32_t right = build(middle, last);
    bvh.nodes[self].right = right;
    bvh.nodes[self].after = static_cast<uint32_t>(bvh.nodes.size());
    return self;
  }
};

}  // namespace

BvhTopology::BvhTopology(const std::vector<Vec3> &x, const std::vector<Tri> &triangles,
                         uint32_t leaf_size)
    : order(triangles.size()) {
  std::iota(order.begin(), order.end(), 0u);
  BvhBuilder builder{*this, {}, leaf_size};
  builder.centre.reserve(triangles.size());
  for (const Tri &t : triangles) builder.centre.push_back(x[t[0]] + x[t[1]] + x[t[2]]);
  if (!triangles.empty()) builder.build(0, static_cast<uint32_t>(triangles.size()));
  leaf_start.push_back(static_cast<uint32_t>(order.size()));
}

Aabb aabb_of(std::span<const Vec3> points) {
  Aabb box;
  for (const Vec3 &p : points) box.add(p);
  return box;
}

Aabb aabb_of(const std::vector<Vec3> &x, const Tri &triangle) {
  Aabb box;
  for (const uint32_t node : triangle) box.add(x[node]);
  return box;
}

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

void SweptBvh::refit(const std::vector<SweptAabbF> &leaves, const std::vector<uint8_t> &rests) {
  bvh_.refit([&](uint32_t leaf, Volume &volume) {
    volume.box = leaves[leaf];
    volume.rests = rests[leaf] != 0;
  });
}

}  // namespace mvs::core
