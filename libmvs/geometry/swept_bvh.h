// A tree of boxes over the triangles of a sheet in motion: which blocks of them could come near
// each other on the way.
//
// A node of the sheet goes from x to `to` along a straight line. Where all go together, each the
// same share of its way at a time, two neighbours that move alike stay as far apart as they are,
// however far they go; where each goes for itself, their ways are what has to keep apart. The tree
// is built once from a shape, by halving at the median of the longest side, down to blocks of at
// most eight triangles, which are asked all at once (see WayLanes). Its boxes are placed anew for
// each motion: n log n once, n from then on.
#pragma once

#include <vector>

#include "geometry/swept_aabb_batch.h"

namespace mvs::core {

class SweptBvh {
 public:
  SweptBvh(const std::vector<Vec3> &shape, const std::vector<Tri> &triangles);

  // The triangles by blocks, block b from block_start()[b] on.
  const std::vector<uint32_t> &triangles() const { return order_; }
  const std::vector<uint32_t> &block_start() const { return block_start_; }
  uint32_t block_count() const { return static_cast<uint32_t>(block_start_.size() - 1); }

  // Where each block goes. Blocks of `still` do not move: nothing is sought between two of them.
  void place(const std::vector<SweptAabbF> &blocks, const std::vector<uint8_t> &still);
  // Calls visit(a, b) once for each pair of blocks that are not apart by a margin of
  // narrow_margin(), a block and itself included, in an order that depends on the shapes alone.
  template <typename Visit>
  void for_near_blocks(float margin, Visit &&visit) const {
    if (!nodes_.empty()) within(0, margin, visit);
  }

 private:
  // In depth-first order: the left child follows its parent.
  struct Node {
    SweptAabbF way;
    bool still;
    uint32_t right;  // child, or none in a leaf
    uint32_t after;  // the first node that is not below it
    uint32_t block;  // of a leaf
  };
  template <typename Visit>
  void within(uint32_t i, float margin, Visit &visit) const {
    const Node &node = nodes_[i];
    if (node.still) return;
    if (node.right == none) {
      visit(node.block, node.block);
      return;
    }
    within(i + 1, margin, visit);
    within(node.right, margin, visit);
    between(i + 1, node.right, margin, visit);
  }

  template <typename Visit>
  void between(uint32_t i, uint32_t j, float margin, Visit &visit) const {
    const Node &a = nodes_[i], &b = nodes_[j];
    if ((a.still && b.still) || surely_apart(a.way, b.way, margin)) return;
    if (a.right == none && b.right == none) {
      visit(a.block, b.block);
    } else if (b.right == none || (a.right != none && a.after - i >= b.after - j)) {
      between(i + 1, j, margin, visit);
      between(a.right, j, margin, visit);
    } else {
      between(i, j + 1, margin, visit);
      between(i, b.right, margin, visit);
    }
  }

  std::vector<Node> nodes_;
  std::vector<uint32_t> order_, block_start_;
};

}  // namespace mvs::core
