// A tree of boxes over the triangles of a sheet in motion: which pairs of them could come near each
// other on the way.
//
// A node of the sheet goes from x to `to` along a straight line. Where all go together, each the
// same share of its way at a time, two neighbours that move alike stay as far apart as they are,
// however far they go; where each goes for itself, their ways are what has to keep apart. The tree
// is built once from a shape, by halving at the median of the longest side, and its boxes are
// placed anew for each motion: n log n once, n from then on.
#pragma once

#include <algorithm>
#include <vector>

#include "base/types.h"

namespace mvs {

enum class Pace { together, each_for_itself };

// Where something is at the two ends of its way, in boxes; for what goes for itself both are the
// box of the whole way.
struct Way {
  struct Box {
    std::array<double, 3> low{1e300, 1e300, 1e300}, high{-1e300, -1e300, -1e300};
    void add(const double *p) {
      for (int k = 0; k < 3; ++k) {
        low[k] = std::min(low[k], p[k]);
        high[k] = std::max(high[k], p[k]);
      }
    }
    void add(const Box &other) {
      add(other.low.data());
      add(other.high.data());
    }
  };
  Box start, end;

  template <typename Nodes>
  static Way of(const Nodes &nodes, const std::vector<Vec3> &x, const std::vector<Vec3> &to,
                Pace pace) {
    Way way;
    for (const uint32_t i : nodes) {
      way.start.add(x[i].data());
      way.end.add(to[i].data());
    }
    if (pace == Pace::each_for_itself) {
      way.start.add(way.end);
      way.end = way.start;
    }
    return way;
  }
};

// Whether two ways keep more than `margin` between them. The sides of the boxes move no faster than
// linearly towards each other, so that a gap along one axis which is there at both ends is there
// all the way.
inline bool apart(const Way &a, const Way &b, double margin) {
  for (uint32_t k = 0; k < 3; ++k) {
    if (a.start.low[k] - b.start.high[k] > margin && a.end.low[k] - b.end.high[k] > margin) {
      return true;
    }
    if (b.start.low[k] - a.start.high[k] > margin && b.end.low[k] - a.end.high[k] > margin) {
      return true;
    }
  }
  return false;
}

class MovingTree {
 public:
  MovingTree(const std::vector<Vec3> &shape, const std::vector<Tri> &triangles);

  // Triangles of `still` do not move: nothing is sought between two of them.
  void place(const std::vector<Vec3> &x, const std::vector<Vec3> &to, Pace pace,
             const std::vector<uint8_t> &still);

  // Calls visit(a, b) once for each pair of different triangles that come within `margin` of each
  // other along every axis, in an order that depends on the shapes alone.
  template <typename Visit>
  void for_near(double margin, Visit &&visit) const {
    if (!nodes_.empty()) within(0, margin, visit);
  }

  // Calls visit(triangle, its way) for those that come within `margin` of something on its way.
  template <typename Visit>
  void for_near(const Way &way, double margin, Visit &&visit) const {
    for (uint32_t i = 0; i < nodes_.size();) {
      const bool out = apart(way, nodes_[i].way, margin);
      if (!out && nodes_[i].right == none) visit(nodes_[i].triangle, nodes_[i].way);
      i = out ? nodes_[i].after : i + 1;
    }
  }

 private:
  // In depth-first order: the left child follows its parent.
  struct Node {
    Way way;
    bool still;
    uint32_t right;     // child, or none in a leaf
    uint32_t after;     // the first node that is not below it
    uint32_t triangle;  // of a leaf
  };
  template <typename Visit>
  void within(uint32_t i, double margin, Visit &visit) const {
    if (nodes_[i].right == none || nodes_[i].still) return;
    within(i + 1, margin, visit);
    within(nodes_[i].right, margin, visit);
    between(i + 1, nodes_[i].right, margin, visit);
  }

  template <typename Visit>
  void between(uint32_t i, uint32_t j, double margin, Visit &visit) const {
    const Node &a = nodes_[i], &b = nodes_[j];
    if ((a.still && b.still) || apart(a.way, b.way, margin)) return;
    if (a.right == none && b.right == none) {
      visit(a.triangle, b.triangle);
    } else if (b.right == none || (a.right != none && a.after - i >= b.after - j)) {
      between(i + 1, j, margin, visit);
      between(a.right, j, margin, visit);
    } else {
      between(i, j + 1, margin, visit);
      between(i, b.right, margin, visit);
    }
  }

  std::vector<Tri> triangles_;
  std::vector<Node> nodes_;
};

}  // namespace mvs
