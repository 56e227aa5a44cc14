// Making the tree, and placing its boxes.
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
    : block_start_{0} {
  const std::vector<SheetBranch> tree = sheet_tree(shape, triangles);
  std::vector<uint32_t> place(tree.size() + 1, 0);  // of a branch among the nodes
  for (uint32_t i = 0; i < tree.size();) {
    place[i] = static_cast<uint32_t>(nodes_.size());
    const bool leaf = triangles_below(tree, i) <= WayLanes::count;
    nodes_.push_back({{}, false, leaf ? none : tree[i].right, tree[i].after, block_count()});
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
}

// Children come after their parents, so that the boxes grow from the back.
void MovingTree::place(const std::vector<NarrowWay> &blocks, const std::vector<uint8_t> &still) {
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

}  // namespace mvs
