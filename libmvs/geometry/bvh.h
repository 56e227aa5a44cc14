// Bounding volume hierarchy over the triangles of a surface, for all queries of the library: boxes
// that overlap a box, triangles nearest to a point, and pairs of leaves of one surface that come
// near each other while it moves.
//
// The topology is built once, top down, by splitting at the median of the longest extent of the
// centroids (n log n, the same on every machine). Volumes are refitted bottom up in linear time, as
// often as the surface moves (van den Bergen, J. Graphics Tools 2(4), 1997). triangle_bvh.h has the
// queries of a surface at rest, swept_bvh.h those of one in motion.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "base/types.h"

namespace mvs::core {

// Nodes in depth-first order: the left child follows its parent.
struct BvhNode {
  uint32_t right;  // child; `none` in a leaf
  uint32_t after;  // the first node that is not below this one
  uint32_t leaf;   // index of a leaf
  bool is_leaf() const { return right == none; }
};

// The hierarchy without volumes. Leaf l holds triangles order[leaf_start[l]] to
// order[leaf_start[l + 1] - 1].
struct BvhTopology {
  // All leaves but the last hold `leaf_size` triangles.
  BvhTopology(const std::vector<Vec3> &x, const std::vector<Tri> &triangles, uint32_t leaf_size);

  uint32_t leaf_count() const { return static_cast<uint32_t>(leaf_start.size() - 1); }

  std::vector<BvhNode> nodes;  // empty without triangles
  std::vector<uint32_t> order, leaf_start;
};

// A hierarchy with a Volume for each node. Volume::add(other) makes a volume enclose another one.
template <typename Volume>
class Bvh {
 public:
  Bvh(const std::vector<Vec3> &x, const std::vector<Tri> &triangles, uint32_t leaf_size)
      : topology_(x, triangles, leaf_size), volume_(topology_.nodes.size()) {}

  // A hierarchy with a topology made for other positions.
  explicit Bvh(BvhTopology topology)
      : topology_(std::move(topology)), volume_(topology_.nodes.size()) {}

  const BvhTopology &topology() const { return topology_; }

  // Sets the volume of every node from those of the leaves: set(leaf, volume) assigns one.
  template <typename Set>
  void refit(Set &&set) {
    for (size_t i = volume_.size(); i-- > 0;) {
      const BvhNode &node = topology_.nodes[i];
      if (node.is_leaf()) {
        set(node.leaf, volume_[i]);
      } else {
        volume_[i] = volume_[i + 1];
        volume_[i].add(volume_[node.right]);
      }
    }
  }

  // Calls visit(triangle) for the triangles of all leaves except those at or below a node with
  // skip(volume), depth first.
  template <typename Skip, typename Visit>
  void for_overlapping(Skip &&skip, Visit &&visit) const {
    for (uint32_t i = 0; i < volume_.size();) {
      const BvhNode &node = topology_.nodes[i];
      const bool skipped = skip(volume_[i]);
      if (!skipped && node.is_leaf()) visit_leaf(node.leaf, visit);
      i = skipped ? node.after : i + 1;
    }
  }

  // Calls visit(triangle) for at least every triangle in volumes with distance2(volume) <= limit2,
  // near volumes first. The visitor may lower limit2.
  template <typename Distance2, typename Visit>
  void for_nearest(Distance2 &&distance2, const double &limit2, Visit &&visit) const {
    // the median split keeps the depth below 33, and each level leaves one entry on the stack
    struct Waiting {
      uint32_t node;
      double distance2;
    };
    std::array<Waiting, 40> stack;
    size_t count = 0;
    if (!volume_.empty()) stack[count++] = {0, distance2(volume_[0])};
    while (count > 0) {
      const auto [i, distance2_of_i] = stack[--count];
      if (distance2_of_i > limit2) continue;
      const BvhNode &node = topology_.nodes[i];
      if (node.is_leaf()) {
        visit_leaf(node.leaf, visit);
        continue;
      }
      Waiting near = {i + 1, distance2(volume_[i + 1])};
      Waiting far = {node.right, distance2(volume_[node.right])};
      if (near.distance2 > far.distance2) std::swap(near, far);
      stack[count++] = far;
      stack[count++] = near;
    }
  }

  // Calls visit(a, b) once for each pair of leaves whose volumes, and those of the nodes above
  // them, are not apart(volume, volume), in an order that depends on the topology alone; and
  // visit(a, a) for each leaf. Skips pairs within a subtree with rests(volume), and between two
  // such subtrees.
  template <typename Rests, typename Apart, typename Visit>
  void for_near_leaves(Rests &&rests, Apart &&apart, Visit &&visit) const {
    if (!volume_.empty()) pairs_within(0, rests, apart, visit);
  }

  // Calls visit(a, b) once for each pair of triangles of those leaves.
  template <typename Apart, typename Visit>
  void for_near_triangles(Apart &&apart, Visit &&visit) const {
    for_near_leaves([](const Volume &) { return false; }, apart,
                    [&](uint32_t a, uint32_t b) {
                      for (uint32_t i = topology_.leaf_start[a]; i < topology_.leaf_start[a + 1];
                           ++i) {
                        const uint32_t first = a == b ? i + 1 : topology_.leaf_start[b];
                        for (uint32_t j = first; j < topology_.leaf_start[b + 1]; ++j) {
                          visit(topology_.order[i], topology_.order[j]);
                        }
                      }
                    });
  }

 private:
  template <typename Visit>
  void visit_leaf(uint32_t leaf, Visit &visit) const {
    const uint32_t last = topology_.leaf_start[leaf + 1];
    for (uint32_t k = topology_.leaf_start[leaf]; k < last; ++k) visit(topology_.order[k]);
  }

  template <typename Rests, typename Apart, typename Visit>
  void pairs_within(uint32_t i, Rests &rests, Apart &apart, Visit &visit) const {
    const BvhNode &node = topology_.nodes[i];
    if (rests(volume_[i])) return;
    if (node.is_leaf()) {
      visit(node.leaf, node.leaf);
      return;
    }
    pairs_within(i + 1, rests, apart, visit);
    pairs_within(node.right, rests, apart, visit);
    pairs_between(i + 1, node.right, rests, apart, visit);
  }

  // Descends into the larger of two subtrees.
  template <typename Rests, typename Apart, typename Visit>
  void pairs_between(uint32_t i, uint32_t j, Rests &rests, Apart &apart, Visit &visit) const {
    const Volume &u = volume_[i], &v = volume_[j];
    if ((rests(u) && rests(v)) || apart(u, v)) return;
    const BvhNode &a = topology_.nodes[i], &b = topology_.nodes[j];
    if (a.is_leaf() && b.is_leaf()) {
      visit(a.leaf, b.leaf);
    } else if (b.is_leaf() || (!a.is_leaf() && a.after - i >= b.after - j)) {
      pairs_between(i + 1, j, rests, apart, visit);
      pairs_between(a.right, j, rests, apart, visit);
    } else {
      pairs_between(i, j + 1, rests, apart, visit);
      pairs_between(i, b.right, rests, apart, visit);
    }
  }

  BvhTopology topology_;
  std::vector<Volume> volume_;  // of each node
};

}  // namespace mvs::core
