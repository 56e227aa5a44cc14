// Recursive coordinate bisection (Berger & Bokhari, IEEE Trans. Comput. C-36, 1987).
#include "energy/node_parts.h"

#include <algorithm>
#include <numeric>

namespace mvs::core {

void NodeParts::divide(const Model &model, uint32_t parts) {
  const auto nodes = static_cast<uint32_t>(model.node_count());
  if (count_ == parts && part_of_.size() == nodes) return;
  count_ = parts;
  part_of_.assign(nodes, 0);
  order_.resize(nodes);
  std::iota(order_.begin(), order_.end(), 0u);
  bisect(model.valve.rest, order_.data(), order_.data() + nodes, 0, parts);
}

// Gives the nodes begin .. end the parts first .. last.
void NodeParts::bisect(const std::vector<Vec3> &x, uint32_t *begin, uint32_t *end, uint32_t first,
                       uint32_t last) {
  if (last - first == 1) {
    for (const uint32_t *i = begin; i != end; ++i) part_of_[*i] = static_cast<uint16_t>(first);
    return;
  }
  if (begin == end) return;
  Vec3 low = x[*begin], high = low;
  for (const uint32_t *i = begin; i != end; ++i) {
    low = low.cwiseMin(x[*i]);
    high = high.cwiseMax(x[*i]);
  }
  int axis = 0;
  (high - low).maxCoeff(&axis);
  const uint32_t half = (last - first) / 2;
  uint32_t *middle = begin + (end - begin) * half / (last - first);
  std::nth_element(begin, middle, end, [&](uint32_t i, uint32_t j) {
    return x[i][axis] != x[j][axis] ? x[i][axis] < x[j][axis] : i < j;
  });
  bisect(x, begin, middle, first, first + half);
  bisect(x, middle, end, first + half, last);
}

}  // namespace mvs::core
