// Building by halves along the longest side.
#include "geometry/triangle_tree.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace mvs::core {
namespace {

constexpr uint32_t leaf_size = 4;

}  // namespace

TriangleTree::TriangleTree(const std::vector<Tri> &triangles, const std::vector<Vec3> &x)
    : triangles_(triangles), x_(x), order_(triangles.size()) {
  std::iota(order_.begin(), order_.end(), 0u);
  std::vector<Vec3> centre;
  centre.reserve(triangles.size());
  for (const Tri &t : triangles) centre.push_back((x[t[0]] + x[t[1]] + x[t[2]]) / 3);
  nodes_.reserve(triangles.size());
  if (!triangles.empty()) build(0, static_cast<uint32_t>(triangles.size()), centre);
}

uint32_t TriangleTree::build(uint32_t first, uint32_t last, const std::vector<Vec3> &centre) {
  const uint32_t n = static_cast<uint32_t>(nodes_.size());
  nodes_.push_back({Box(), first, last - first});
  Box box, centres;
  for (uint32_t i = first; i < last; ++i) {
    for (const uint32_t node : triangles_[order_[i]]) box.extend(x_[node]);
    centres.extend(centre[order_[i]]);
  }
  nodes_[n].box = box;
  if (last - first <= leaf_size) return n;

  Eigen::Index axis;
  centres.sizes().maxCoeff(&axis);
  const uint32_t middle = first + (last - first) / 2;
  const auto before = [&](uint32_t l, uint32_t r) {
    return centre[l][axis] != centre[r][axis] ? centre[l][axis] < centre[r][axis] : l < r;
  };
  std::nth_element(order_.begin() + first, order_.begin() + middle, order_.begin() + last, before);
  build(first, middle, centre);
  const uint32_t right = build(middle, last, centre);
  nodes_[n].first = right;
  nodes_[n].count = 0;
  return n;
}

TriangleTree::Hit TriangleTree::closest(const Vec3 &p) const {
  Hit hit;
  hit.distance2 = std::numeric_limits<double>::infinity();
  std::array<double, 3> weight{};
  visit_near(p, hit.distance2, [&](uint32_t t) {
    const TrianglePoint q = closest_on(t, p);
    const bool tie = q.distance2 == hit.distance2 && t < hit.triangle;
    if (q.distance2 < hit.distance2 || tie) {
      hit.triangle = t;
      hit.distance2 = q.distance2;
      weight = q.weight;
    }
  });
  if (hit.triangle != none) hit.point = point_at(hit.triangle, weight);
  return hit;
}

}  // namespace mvs::core
