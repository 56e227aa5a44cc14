// Bounding volume hierarchy over the triangles of a surface, for all queries of the library: boxes
// that overlap a box, triangles nearest to a point, and pairs of leaves of one surface that come
// near each other while it moves.
//
// The topology is built once, top down, by splitting at the median of the longest extent of the
// centroids (n log n, the same on every machine). Volumes are refitted bottom up in linear time, as
// often as the surface moves (van den Bergen, J. Graphics Tools 2(4), 1997).
#pragma once

#include <algorithm>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "base/types.h"
#include "geometry/distance.h"
#include "geometry/swept_aabb_batch.h"

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

// An axis-aligned bounding box.
struct Aabb {
  Vec3 low = Vec3::Constant(1e300), high = Vec3::Constant(-1e300);

  double longest_side() const { return (high - low).maxCoeff(); }
  void add(const Vec3 &p) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  void add(const Aabb &other) {
    low = low.cwiseMin(other.low);
    high = high.cwiseMax(other.high);
  }
  bool overlaps(const Aabb &other) const {
    return (low.array() <= other.high.array()).all() && (other.low.array() <= high.array()).all();
  }
  double distance2(const Vec3 &p) const {
    double sum = 0;
    for (int k = 0; k < 3; ++k) {
      const double off = std::max(std::max(0.0, low[k] - p[k]), p[k] - high[k]);
      sum += off * off;
    }
    return sum;
  }
  double distance2(const Aabb &other) const {
    double sum = 0;
    for (int k = 0; k < 3; ++k) {
      const double off = std::max({0.0, low[k] - other.high[k], other.low[k] - high[k]});
      sum += off * off;
    }
    return sum;
  }
};

Aabb aabb_of(std::span<const Vec3> points);
Aabb aabb_of(const std::vector<Vec3> &x, const Tri &triangle);

// The triangles of a surface at rest, with their boxes.
class BoxedTriangles {
 public:
  // Keeps references to both.
  BoxedTriangles(const std::vector<Tri> &triangles, const std::vector<Vec3> &x);

  const Aabb &box_of(uint32_t triangle) const { return box_[triangle]; }
  TrianglePoint closest_on(uint32_t triangle, const Vec3 &p) const {
    const Tri &t = triangles_[triangle];
    return closest_on_triangle(p, x_[t[0]], x_[t[1]], x_[t[2]]);
  }
  Vec3 point_at(uint32_t triangle, const std::array<double, 3> &weight) const {
    const Tri &t = triangles_[triangle];
    return weight[0] * x_[t[0]] + weight[1] * x_[t[1]] + weight[2] * x_[t[2]];
  }

 private:
  const std::vector<Tri> &triangles_;
  const std::vector<Vec3> &x_;
  std::vector<Aabb> box_;
};

// A surface at rest: boxes that overlap a box, triangles near a point, pairs near each other.
class TriangleBvh : public BoxedTriangles {
 public:
  // Keeps references to both: they must outlive the hierarchy.
  TriangleBvh(const std::vector<Tri> &triangles, const std::vector<Vec3> &x);
  // The same with the topology of these triangles at other positions: the results do not depend on
  // the topology.
  TriangleBvh(const std::vector<Tri> &triangles, const std::vector<Vec3> &x, BvhTopology topology);

  // Calls visit(triangle) for every triangle whose box overlaps `box`.
  template <typename Visit>
  void for_overlapping(const Aabb &box, Visit &&visit) const {
    bvh_.for_overlapping([&](const Aabb &volume) { return !volume.overlaps(box); },
                         [&](uint32_t t) {
                           if (box_of(t).overlaps(box)) visit(t);
                         });
  }
  // Calls visit(a, b) once for at least every pair of triangles whose boxes are no further apart
  // than sqrt(limit2); the visitor looks at the boxes itself.
  template <typename Visit>
  void for_near_pairs(double limit2, Visit &&visit) const {
    bvh_.for_near_triangles([&](const Aabb &a, const Aabb &b) { return a.distance2(b) > limit2; },
                            visit);
  }

  // Calls visit(triangle) for at least every triangle nearer to p than sqrt(limit2), near boxes
  // first; the visitor may lower limit2, which it holds by reference.
  template <typename Visit>
  void visit_near(const Vec3 &p, const double &limit2, Visit &&visit) const {
    bvh_.for_nearest([&](const Aabb &volume) { return volume.distance2(p); }, limit2, visit);
  }

  // The closest point of all triangles; on equal distance, that of the first triangle.
  struct Hit {
    uint32_t triangle = none;
    double distance2 = 0;
    Vec3 point;
  };
  // `hint`: a triangle that may be close, or `none`; it saves time and changes nothing else.
  Hit closest(const Vec3 &p, uint32_t hint = none) const;
  // Whether a triangle is nearer to p than a distance in m.
  bool is_within(const Vec3 &p, double distance) const;

 private:
  Bvh<Aabb> bvh_;
};

// The closest point to p of the triangles looked at so far; on equal distance, that of the first
// triangle.
class ClosestSoFar {
 public:
  // Keeps references to both.
  ClosestSoFar(const BoxedTriangles &triangles, const Vec3 &p) : triangles_(triangles), p_(p) {}

  void look_at(uint32_t t) {
    if (triangles_.box_of(t).distance2(p_) > distance2_) return;
    const TrianglePoint q = triangles_.closest_on(t, p_);
    const bool is_tie = q.distance2 == distance2_ && t < triangle_;
    if (!(q.distance2 < distance2_ || is_tie)) return;
    triangle_ = t;
    distance2_ = q.distance2;
    weight_ = q.weight;
  }
  // Infinite before the first triangle.
  const double &distance2() const { return distance2_; }
  TriangleBvh::Hit hit() const {
    if (triangle_ == none) return {none, distance2_, Vec3::Zero()};
    return {triangle_, distance2_, triangles_.point_at(triangle_, weight_)};
  }

 private:
  const BoxedTriangles &triangles_;
  const Vec3 &p_;
  uint32_t triangle_ = none;
  double distance2_ = std::numeric_limits<double>::infinity();
  std::array<double, 3> weight_{};
};

// A surface in motion: pairs of leaves, of at most eight triangles each, that come near each other
// during a step. Nodes move from `from` to `to` along straight lines. If all move together (the
// same share of their motion at a time), neighbours that move alike keep their distance; if each
// node moves independently, the boxes of their whole motions decide.
class SweptBvh {
 public:
  SweptBvh(const std::vector<Vec3> &x, const std::vector<Tri> &triangles)
      : bvh_(x, triangles, SweptAabb8::count) {}

  const BvhTopology &topology() const { return bvh_.topology(); }

  // Sets the swept boxes of the leaves. Pairs of leaves that rest are not reported.
  void refit(const std::vector<SweptAabbF> &leaves, const std::vector<uint8_t> &rests);
  // Calls visit(a, b) once for each pair of leaves that are not apart by a margin of
  // float_margin(), a leaf and itself included, in an order that depends on the topology alone.
  template <typename Visit>
  void for_near_leaves(float margin, Visit &&visit) const {
    bvh_.for_near_leaves(
        [](const Volume &v) { return v.rests; },
        [&](const Volume &a, const Volume &b) { return surely_apart(a.box, b.box, margin); },
        visit);
  }

 private:
  struct Volume {
    SweptAabbF box;
    bool rests = false;
    void add(const Volume &other) {
      box.add(other.box);
      rests = rests && other.rests;
    }
  };
  Bvh<Volume> bvh_;
};

}  // namespace mvs::core
