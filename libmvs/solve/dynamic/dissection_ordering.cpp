// Nested dissection of the graph of a step matrix.
#include "solve/dynamic/dissection_ordering.h"

#include "linalg/nested_dissection.h"

namespace mvs::core {

const std::vector<uint32_t> &DissectionOrdering::find(const StepMatrix &matrix,
                                                      const std::vector<Vec3> &x) {
  const BlockMatrix &m = matrix.blocks();
  pairs_.clear();
  places_.clear();
  for (uint32_t c = 0; c < m.size(); ++c) {
    places_.push_back(x[matrix.node(c)]);
    for (uint32_t k = m.start[c] + 1; k < m.start[c + 1]; ++k) {
      if (!m.value[k].isZero(0)) pairs_.push_back({c, m.row[k]});
    }
  }
  nodes_ = nested_dissection_order(pairs_, places_);
  for (uint32_t &row : nodes_) row = matrix.node(row);
  return nodes_;
}

}  // namespace mvs::core
