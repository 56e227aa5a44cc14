// What comes up with each block of triangles and with each triangle of a sheet, so that pairs of
// vertices, triangles and edges come up once: a vertex with the first block that has it, an edge
// with the first triangle.
#pragma once

#include <span>
#include <vector>

#include "geometry/swept_bvh.h"
#include "model/model.h"

namespace mvs::core {

class LeafParts {
 public:
  LeafParts(const Model &model, const SweptBvh &tree);

  // By blocks.
  const std::vector<uint32_t> &vertices() const { return vertex_; }
  std::span<const uint32_t> vertices_of(uint32_t block) const {
    return {vertex_.data() + vertex_start_[block], vertex_.data() + vertex_start_[block + 1]};
  }
  std::span<const uint32_t> edges_of(uint32_t triangle) const {
    return {edge_.data() + edge_start_[triangle], edge_.data() + edge_start_[triangle + 1]};
  }
  uint32_t owner_of(uint32_t edge) const { return owner_[edge]; }

 private:
  std::vector<uint32_t> vertex_start_, vertex_, edge_start_, edge_, owner_;
};

}  // namespace mvs::core
