// A tree of boxes over triangles: the nearest ones first.
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "base/types.h"
#include "geometry/distance.h"

namespace mvs::core {

class TriangleTree {
 public:
  // Keeps references to both: they must outlive the tree.
  TriangleTree(const std::vector<Tri> &triangles, const std::vector<Vec3> &x);

  // Calls visit(triangle) for at least every triangle nearer to p than sqrt(limit2), near boxes
  // first; the visitor may lower limit2, which it holds by reference, as it finds something.
  template <typename Visit>
  void visit_near(const Vec3 &p, const double &limit2, Visit visit) const;

  // The closest point of all triangles; on equal distance, that of the first triangle.
  struct Hit {
    uint32_t triangle = none;
    double distance2 = 0;
    Vec3 point;
  };
  Hit closest(const Vec3 &p) const;

  TrianglePoint closest_on(uint32_t triangle, const Vec3 &p) const {
    const Tri &t = triangles_[triangle];
    return closest_on_triangle(p, x_[t[0]], x_[t[1]], x_[t[2]]);
  }
  Vec3 point_at(uint32_t triangle, const std::array<double, 3> &weight) const {
    const Tri &t = triangles_[triangle];
    return weight[0] * x_[t[0]] + weight[1] * x_[t[1]] + weight[2] * x_[t[2]];
  }

 private:
  using Box = Eigen::AlignedBox3d;
  struct Node {
    Box box;
    uint32_t first, count;  // of order_; a branch has count 0 and its second child at `first`
  };
  uint32_t build(uint32_t first, uint32_t last, const std::vector<Vec3> &centre);

  const std::vector<Tri> &triangles_;
  const std::vector<Vec3> &x_;
  std::vector<uint32_t> order_;
  std::vector<Node> nodes_;  // a branch's first child follows it
};

template <typename Visit>
void TriangleTree::visit_near(const Vec3 &p, const double &limit2, Visit visit) const {
  // halving keeps the depth below 33, and each level leaves one entry waiting
  std::array<uint32_t, 40> waiting;
  size_t count = 0;
  if (!nodes_.empty()) waiting[count++] = 0;
  while (count > 0) {
    const uint32_t n = waiting[--count];
    const Node &node = nodes_[n];
    if (node.box.squaredExteriorDistance(p) > limit2) continue;
    for (uint32_t i = 0; i < node.count; ++i) visit(order_[node.first + i]);
    if (node.count > 0) continue;
    const uint32_t left = n + 1, right = node.first;
    const bool left_first =
        nodes_[left].box.squaredExteriorDistance(p) <= nodes_[right].box.squaredExteriorDistance(p);
    waiting[count++] = left_first ? right : left;
    waiting[count++] = left_first ? left : right;
  }
}

}  // namespace mvs::core
