#include "collision/leaf_parts.h"

namespace mvs::core {

LeafParts::LeafParts(const Model &model, const SweptBvh &tree)
    : vertex_start_{0}, edge_start_{0}, owner_(model.topology.edges.size(), none) {
  std::vector<uint8_t> taken(model.node_count(), 0);
  const auto &start = tree.block_start();
  for (size_t block = 0; block + 1 < start.size(); ++block) {
    for (uint32_t k = start[block]; k < start[block + 1]; ++k) {
      for (const uint32_t v : model.valve.triangles[tree.triangles()[k]]) {
        if (!taken[v]) vertex_.push_back(v);
        taken[v] = 1;
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
