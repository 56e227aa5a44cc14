// Building a tree of boxes.
#include "geometry/box_tree.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace mvs::core {
namespace {

constexpr uint32_t leaf_items = 4;

}  // namespace

Box box_of(const std::vector<Vec3> &x, const Tri &triangle) {
  Box box;
  for (const uint32_t node : triangle) box.add(x[node]);
  return box;
}

AabbTree::AabbTree(std::vector<Box> boxes) : boxes_(std::move(boxes)), items_(boxes_.size()) {
  std::iota(items_.begin(), items_.end(), 0u);
  nodes_.reserve(boxes_.size());
  if (!items_.empty()) build(0, static_cast<uint32_t>(items_.size()));
}

void AabbTree::build(uint32_t first, uint32_t last) {
  const size_t self = nodes_.size();
  nodes_.emplace_back();
  Box box, centres;
  for (uint32_t k = first; k < last; ++k) {
    box.add(boxes_[items_[k]]);
    centres.add(Vec3(boxes_[items_[k]].low + boxes_[items_[k]].high));
  }
  nodes_[self].box = box;
  if (last - first <= leaf_items) {
    nodes_[self].first = first;
    nodes_[self].last = last;
  } else {
    Eigen::Index axis;
    (centres.high - centres.low).maxCoeff(&axis);
    const uint32_t middle = first + (last - first) / 2;
    const auto key = [&](uint32_t item) {
      return std::pair(boxes_[item].low[axis] + boxes_[item].high[axis], item);
    };
    std::nth_element(items_.begin() + first, items_.begin() + middle, items_.begin() + last,
                     [&](uint32_t a, uint32_t b) { return key(a) < key(b); });
    build(first, middle);
    build(middle, last);
  }
  nodes_[self].after = static_cast<uint32_t>(nodes_.size());
}

}  // namespace mvs::core
