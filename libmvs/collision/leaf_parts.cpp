// One pass over the leaves and one over the triangles.
#include "collision/leaf_parts.h"

namespace mvs::core {

LeafParts::LeafParts(const Model &model, const BvhTopology &bvh)
    : vertex_start_{0}, edge_start_{0}, owner_(model.topology.edges.size(), none) {
  std::vector<uint8_t> assigned(model.node_count(), 0);
  for (uint32_t leaf = 0; leaf < bvh.leaf_count(); ++leaf) {
    for (uint32_t k = bvh.leaf_start[leaf]; k < bvh.leaf_start[leaf + 1]; ++k) {
      for (const uint32_t v : model.valve.triangles[bvh.order[k]]) {
        if (!assigned[v]) vertex_.push_back(v);
        assigned[v] = 1;
      }
    }
    vertex_start_.push_back(static_cast<uint32_t>(vertex_.size()));
  }
  for (uint32_t t = 0; t < model.valve.triangles.size(); ++t) {
    for (const uint32_t edge : model.topology.triangle_edges[t]) {
      if (owner_[edge] != none) continue;
      edge_.push_back(edge);
      owner_[edge] = t;
    }
    edge_start_.push_back(static_cast<uint32_t>(edge_.size()));
  }
}

}  // namespace mvs::core
