// Building the tree and placing its boxes.
#include "base/moving_tree.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace mvs {

MovingTree::MovingTree(const std::vector<Vec3> &shape, const std::vector<Tri> &triangles)
    : triangles_(triangles) {
  std::vector<uint32_t> items(triangles_.size());
  std::iota(items.begin(), items.end(), 0u);
  std::vector<Vec3> centre;
  for (const Tri &t : triangles_) centre.push_back(shape[t[0]] + shape[t[1]] + shape[t[2]]);
  if (triangles_.empty()) return;
  nodes_.reserve(2 * triangles_.size() - 1);
  build(items, 0, static_cast<uint32_t>(triangles_.size()), centre);
}

uint32_t MovingTree::build(std::vector<uint32_t> &items, uint32_t first, uint32_t last,
                           const std::vector<Vec3> &centre) {
  const auto self = static_cast<uint32_t>(nodes_.size());
  nodes_.push_back({{}, false, none, self + 1, items[first]});
  if (last - first == 1) return self;
  Vec3 low = Vec3::Constant(1e300), high = -low;
  for (uint32_t k = first; k < last; ++k) {
    low = low.cwiseMin(centre[items[k]]);
    high = high.cwiseMax(centre[items[k]]);
  }
  Eigen::Index axis;
  (high - low).maxCoeff(&axis);
  const uint32_t middle = first + (last - first) / 2;
  std::nth_element(items.begin() + first, items.begin() + middle, items.begin() + last,
                   [&](uint32_t a, uint32_t b) {
                     return std::pair(centre[a][axis], a) < std::pair(centre[b][axis], b);
                   });
  build(items, first, middle, centre);
  nodes_[self].right = build(items, middle, last, centre);
  nodes_[self].after = static_cast<uint32_t>(nodes_.size());
  return self;
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
