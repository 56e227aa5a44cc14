// Nested dissection of the graph of a step matrix.
#include "solve/dynamic/dissection_ordering.h"

#include "linalg/nested_dissection.h"

namespace mvs::core {

std::vector<uint32_t> dissection_order(const StepMatrix &matrix, const std::vector<Vec3> &x) {
  const BlockMatrix &m = matrix.blocks();
  std::vector<Edge> pairs;   // of rows
  std::vector<Vec3> places;  // m, by rows
  for (uint32_t c = 0; c < m.size(); ++c) {
    places.push_back(x[matrix.node(c)]);
    for (uint32_t k = m.start[c] + 1; k < m.start[c + 1]; ++k) {
      if (!m.value[k].isZero(0)) pairs.push_back({c, m.row[k]});
    }
  }
  std::vector<uint32_t> nodes = nested_dissection_order(pairs, places);
  for (uint32_t &row : nodes) row = matrix.node(row);
  return nodes;
}

}  // namespace mvs::core
