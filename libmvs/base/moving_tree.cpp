// Placing the boxes of the tree.
#include "base/moving_tree.h"

#include "base/sheet_tree.h"

namespace mvs {

MovingTree::MovingTree(const std::vector<Vec3> &shape, const std::vector<Tri> &triangles)
    : triangles_(triangles) {
  for (const SheetBranch &b : sheet_tree(shape, triangles)) {
    nodes_.push_back({{}, false, b.right, b.after, b.triangle});
  }
}

// Children come after their parents, so that the boxes grow from the back.
void MovingTree::place(const std::vector<Vec3> &x, const std::vector<Vec3> &to, Pace pace,
                       const std::vector<uint8_t> &still) {
  for (size_t i = nodes_.size(); i-- > 0;) {
    Node &node = nodes_[i];
    if (node.right == none) {
      node.still = still[node.triangle];
      node.way = Way::of(triangles_[node.triangle], x, to, pace);
    } else {
      const Node &left = nodes_[i + 1], &right = nodes_[node.right];
      node.still = left.still && right.still;
      node.way = left.way;
      node.way.start.add(right.way.start);
      node.way.end.add(right.way.end);
    }
  }
}

}  // namespace mvs
