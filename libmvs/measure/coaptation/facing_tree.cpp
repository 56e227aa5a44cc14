// Volumes of the hierarchy.
#include "measure/coaptation/facing_tree.h"

namespace mvs::core {
namespace {

constexpr uint32_t faced_in_leaf = 4;  // triangles

}  // namespace

FacingTree::FacingTree(const std::vector<Tri> &triangles, const std::vector<Vec3> &x,
                       const Surface &surface)
    : BoxedTriangles(triangles, x), bvh_(x, triangles, faced_in_leaf) {
  const BvhTopology &topology = bvh_.topology();
  bvh_.refit([&](uint32_t leaf, Volume &volume) {
    for (uint32_t k = topology.leaf_start[leaf]; k < topology.leaf_start[leaf + 1]; ++k) {
      volume.box.add(box_of(topology.order[k]));
      volume.normals.add(surface.normal[topology.order[k]]);
    }
  });
}

}  // namespace mvs::core
