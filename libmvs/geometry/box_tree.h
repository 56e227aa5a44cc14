// A balanced tree of boxes over triangles: which of them touch a box.
#pragma once

#include <vector>

#include "base/types.h"

namespace mvs::core {

struct Box {
  Vec3 low = Vec3::Constant(1e300), high = Vec3::Constant(-1e300);

  void add(const Vec3 &p) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  void add(const Box &other) {
    low = low.cwiseMin(other.low);
    high = high.cwiseMax(other.high);
  }
  bool touches(const Box &other) const {
    return (low.array() <= other.high.array()).all() && (other.low.array() <= high.array()).all();
  }
};

Box box_of(const std::vector<Vec3> &x, const Tri &triangle);

// Built by halving at the median of the longest side: n log n for any distribution of sizes, and
// the same tree on every machine.
class AabbTree {
 public:
  explicit AabbTree(std::vector<Box> boxes);

  const std::vector<Box> &boxes() const { return boxes_; }

  // Calls visit(item) for every item whose box touches `box`.
  template <typename Visit>
  void for_touching(const Box &box, Visit visit) const {
    for (size_t n = 0; n < nodes_.size();) {
      const Node &node = nodes_[n];
      if (!node.box.touches(box)) {
        n = node.after;
        continue;
      }
      for (uint32_t k = node.first; k < node.last; ++k) {
        if (boxes_[items_[k]].touches(box)) visit(items_[k]);
      }
      ++n;
    }
  }

 private:
  // In depth-first order: the first child follows its parent; `after` skips the whole subtree.
  // Only leaves hold items.
  struct Node {
    Box box;
    uint32_t first = 0, last = 0;
    uint32_t after = 0;
  };

  void build(uint32_t first, uint32_t last);

  std::vector<Box> boxes_;
  std::vector<uint32_t> items_;
  std::vector<Node> nodes_;
};

}  // namespace mvs::core
