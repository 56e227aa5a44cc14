#include "geometry/bvh_topology.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace mvs::core {
namespace {

struct Builder {
  std::vector<Vec3> centre;
  std::vector<uint32_t> items;
  std::vector<BvhNode> nodes;
  uint32_t block;

  // The part of the tree over items first .. last, triangles in their places.
  uint32_t build(uint32_t first, uint32_t last) {
    const auto self = static_cast<uint32_t>(nodes.size());
    nodes.push_back({none, self + 1, first});
    if (last - first <= block) return self;
    Vec3 low = Vec3::Constant(1e300), high = -low;
    for (uint32_t k = first; k < last; ++k) {
      low = low.cwiseMin(centre[items[k]]);
      high = high.cwiseMax(centre[items[k]]);
    }
    Eigen::Index axis;
    (high - low).maxCoeff(&axis);
    const uint32_t blocks = (last - first + block - 1) / block;
    const uint32_t middle = first + (blocks + 1) / 2 * block;
    std::nth_element(items.begin() + first, items.begin() + middle, items.begin() + last,
                     [&](uint32_t a, uint32_t b) {
                       return std::pair(centre[a][axis], a) < std::pair(centre[b][axis], b);
                     });
    build(first, middle);
    nodes[self].right = build(middle, last);
    nodes[self].after = static_cast<uint32_t>(nodes.size());
    return self;
  }
};

}  // namespace

BvhTopology make_bvh_topology(const std::vector<Vec3> &shape, const std::vector<Tri> &triangles,
                              uint32_t block) {
  if (triangles.empty()) return {};
  Builder builder;
  builder.block = block;
  builder.items.resize(triangles.size());
  std::iota(builder.items.begin(), builder.items.end(), 0u);
  for (const Tri &t : triangles) {
    builder.centre.push_back(shape[t[0]] + shape[t[1]] + shape[t[2]]);
  }
  builder.build(0, static_cast<uint32_t>(triangles.size()));
  return {std::move(builder.nodes), std::move(builder.items)};
}

}  // namespace mvs::core
