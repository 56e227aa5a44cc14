// A tree of boxes over the triangles of a sheet in motion: which of them could come near each other
// on the way.
//
// A node of the sheet goes from x to `to` along a straight line. Where all go together, each the
// same share of its way at a time, two neighbours that move alike stay as far apart as they are,
// however far they go; where each goes for itself, their ways are what has to keep apart. The tree
// is built once from a shape, by halving at the median of the longest side, down to blocks of at
// most eight triangles, which are asked all at once. Its boxes are placed anew for each motion:
// n log n once, n from then on.
#pragma once

#include <bit>

#include "base/way_lanes.h"

namespace mvs {

class MovingTree {
 public:
  MovingTree(const std::vector<Vec3> &shape, const std::vector<Tri> &triangles);

  // Triangles of `still` do not move: nothing is sought between two of them.
  void place(const std::vector<Vec3> &x, const std::vector<Vec3> &to, Pace pace,
             const std::vector<uint8_t> &still);

  // The triangles by blocks, block b from block_start()[b] on; and where each goes.
  const std::vector<uint32_t> &triangles() const { return order_; }
  const std::vector<uint32_t> &block_start() const { return block_start_; }
  const Way &way_of(uint32_t triangle) const { return way_[triangle]; }

  // Calls visit(a, b) once for each pair of blocks that come within `margin` of each other along
  // every axis, a block and itself included, in an order that depends on the shapes alone.
  template <typename Visit>
  void for_near_blocks(double margin, Visit &&visit) const {
    if (!nodes_.empty()) within(0, margin, visit);
  }
  // What is asked of a block: a way, widened by the margin and what rounding takes from it.
  NarrowWay narrow(const Way &way, double margin) const { return {way, margin + error_}; }
  // Calls visit(triangle) for those of a block that may come near a way from narrow(), which
  // apart() tells for sure.
  template <typename Visit>
  void for_near(uint32_t block, const NarrowWay &way, Visit &&visit) const {
    if (surely_apart(block_way_[block], way)) return;
    const uint32_t *triangle = order_.data() + block_start_[block];
    for (uint32_t lanes = lanes_[block].near(way); lanes != 0; lanes &= lanes - 1) {
      visit(triangle[std::countr_zero(lanes)]);
    }
  }
  // The same for two of a way, the second with a smaller margin: visit(triangle, may be near it).
  template <typename Visit>
  void for_near(uint32_t block, const NarrowWay &way, const NarrowWay &closer,
                Visit &&visit) const {
    if (surely_apart(block_way_[block], way)) return;
    const uint32_t *triangle = order_.data() + block_start_[block];
    uint32_t lanes = lanes_[block].near(way);
    if (lanes == 0) return;
    for (const uint32_t close = lanes_[block].near(closer); lanes != 0; lanes &= lanes - 1) {
      visit(triangle[std::countr_zero(lanes)], (close & lanes & -lanes) != 0);
    }
  }

 private:
  // In depth-first order: the left child follows its parent.
  struct Node {
    Way way;
    bool still;
    uint32_t right;  // child, or none in a leaf
    uint32_t after;  // the first node that is not below it
    uint32_t block;  // of a leaf
  };
  template <typename Visit>
  void within(uint32_t i, double margin, Visit &visit) const {
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
  void between(uint32_t i, uint32_t j, double margin, Visit &visit) const {
    const Node &a = nodes_[i], &b = nodes_[j];
    if ((a.still && b.still) || apart(a.way, b.way, margin)) return;
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

  void place_block(uint32_t block, Node &node, const std::vector<uint8_t> &still);

  std::vector<Tri> triangles_;
  std::vector<Node> nodes_;
  std::vector<uint32_t> order_, block_start_;
  std::vector<Way> way_;         // of each triangle
  std::vector<WayLanes> lanes_;  // of each block, and the way of all of it
  std::vector<NarrowWay> block_way_;
  double error_ = 0;  // m, of single precision
};

}  // namespace mvs
