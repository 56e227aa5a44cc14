// Construction of the hierarchy by median splits.
#include "geometry/bvh.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "geometry/aabb.h"

namespace mvs::core {
namespace {

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

}  // namespace mvs::core
