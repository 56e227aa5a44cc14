// Volumes of the hierarchy.
#include "measure/coaptation/facing_tree.h"

#include "measure/tissue/sheet_topology.h"

namespace mvs::core {

FacingTree::FacingTree(const Model &model, const std::vector<Vec3> &x, const Surface &surface)
    : BoxedTriangles(model.valve.triangles, x), bvh_(*sheet_topology(model)) {
  const BvhTopology &topology = bvh_.topology();
  bvh_.refit([&](uint32_t leaf, Volume &volume) {
    for (uint32_t k = topology.leaf_start[leaf]; k < topology.leaf_start[leaf + 1]; ++k) {
      volume.box.add(box_of(topology.order[k]));
      volume.normals.add(surface.normal[topology.order[k]]);
    }
  });
}

}  // namespace mvs::core
