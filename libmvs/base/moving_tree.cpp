// Placing the boxes of the tree.
#include "base/moving_tree.h"

#include "base/sheet_tree.h"

namespace mvs {
namespace {

// Triangles below a branch: it and all below it are one less than twice as many.
uint32_t triangles_below(const std::vector<SheetBranch> &tree, uint32_t branch) {
  return (tree[branch].after - branch + 1) / 2;
}

}  // namespace

MovingTree::MovingTree(const std::vector<Vec3> &shape, const std::vector<Tri> &triangles)
    : triangles_(triangles), block_start_{0}, way_(triangles.size()) {
  const std::vector<SheetBranch> tree = sheet_tree(shape, triangles);
  std::vector<uint32_t> place(tree.size() + 1, 0);  // of a branch among the nodes
  for (uint32_t i = 0; i < tree.size();) {
    place[i] = static_cast<uint32_t>(nodes_.size());
    const bool leaf = triangles_below(tree, i) <= WayLanes::count;
    const auto block = static_cast<uint32_t>(block_start_.size() - 1);
    nodes_.push_back({{}, false, leaf ? none : tree[i].right, tree[i].after, block});
    const uint32_t next = leaf ? tree[i].after : i + 1;
    for (; leaf && i < next; ++i) {
      if (tree[i].right == none) order_.push_back(tree[i].triangle);
    }
    if (leaf) block_start_.push_back(static_cast<uint32_t>(order_.size()));
    i = next;
  }
  place[tree.size()] = static_cast<uint32_t>(nodes_.size());
  for (Node &node : nodes_) {
    if (node.right != none) node.right = place[node.right];
    node.after = place[node.after];
  }
  lanes_.resize(block_start_.size() - 1);
  block_way_.resize(lanes_.size());
  for (WayLanes &lanes : lanes_) lanes.clear();
}

// Children come after their parents, so that the boxes grow from the back.
void MovingTree::place(const std::vector<Vec3> &x, const std::vector<Vec3> &to, Pace pace,
                       const std::vector<uint8_t> &still) {
  for (size_t t = 0; t < way_.size(); ++t) way_[t] = Way::of(triangles_[t], x, to, pace);
  for (size_t i = nodes_.size(); i-- > 0;) {
    Node &node = nodes_[i];
    if (node.right == none) {
      place_block(node.block, node, still);
    } else {
      const Node &left = nodes_[i + 1], &right = nodes_[node.right];
      node.still = left.still && right.still;
      node.way = left.way;
      node.way.add(right.way);
    }
  }
  if (!nodes_.empty()) error_ = narrow_error(nodes_[0].way);
}

void MovingTree::place_block(uint32_t block, Node &node, const std::vector<uint8_t> &still) {
  node.still = true;
  node.way = {};
  for (uint32_t k = block_start_[block]; k < block_start_[block + 1]; ++k) {
    const uint32_t t = order_[k];
    node.still = node.still && still[t];
    node.way.add(way_[t]);
    lanes_[block].set(k - block_start_[block], way_[t]);
  }
  block_way_[block] = {node.way, 0};
}

}  // namespace mvs
