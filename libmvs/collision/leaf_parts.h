// Assignment of vertices to leaves of the hierarchy and of edges to triangles, so that each pair of
// vertices, triangles and edges is found once: a vertex belongs to the first leaf that has it, an
// edge to the first triangle.
#pragma once

#include <span>
#include <vector>

#include "geometry/bvh.h"
#include "model/model.h"

namespace mvs::core {

class LeafParts {
 public:
  LeafParts(const Model &model, const BvhTopology &bvh);

  // All vertices of triangles, by leaves.
  const std::vector<uint32_t> &vertices() const { return vertex_; }
  std::span<const uint32_t> vertices_of(uint32_t leaf) const {
    return {vertex_.data() + vertex_start_[leaf], vertex_.data() + vertex_start_[leaf + 1]};
  }
  std::span<const uint32_t> edges_of(uint32_t triangle) const {
    return {edge_.data() + edge_start_[triangle], edge_.data() + edge_start_[triangle + 1]};
  }
  uint32_t owner_of(uint32_t edge) const { return owner_[edge]; }

 private:
  std::vector<uint32_t> vertex_start_, vertex_, edge_start_, edge_, owner_;
};

}  // namespace mvs::core
