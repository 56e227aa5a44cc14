// Making the tree, and placing its boxes.
#include "geometry/swept_bvh.h"

#include <utility>

#include "geometry/bvh_topology.h"

namespace mvs::core {
SweptBvh::SweptBvh(const std::vector<Vec3> &shape, const std::vector<Tri> &triangles) {
  BvhTopology tree = make_bvh_topology(shape, triangles, SweptAabb8::count);
  for (const BvhNode &branch : tree.branches) {
    const auto block = static_cast<uint32_t>(block_start_.size());
    nodes_.push_back({{}, false, branch.right, branch.after, block});
    if (branch.right == none) block_start_.push_back(branch.first);
  }
  order_ = std::move(tree.order);
  block_start_.push_back(static_cast<uint32_t>(order_.size()));
}

// Children come after their parents, so that the boxes grow from the back.
void SweptBvh::place(const std::vector<SweptAabbF> &blocks, const std::vector<uint8_t> &still) {
  for (size_t i = nodes_.size(); i-- > 0;) {
    Node &node = nodes_[i];
    if (node.right == none) {
      node.way = blocks[node.block];
      node.still = still[node.block] != 0;
    } else {
      const Node &left = nodes_[i + 1], &right = nodes_[node.right];
      node.still = left.still && right.still;
      node.way = left.way;
      node.way.add(right.way);
    }
  }
}

}  // namespace mvs::core
