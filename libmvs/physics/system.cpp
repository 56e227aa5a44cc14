// Numbering the rows of the system.
#include "physics/system.h"

#include "base/factor.h"

namespace mvs {

void System::set_pattern(const Model &model, const std::vector<Edge> &pairs) {
  const auto n = static_cast<uint32_t>(model.node_count());
  std::vector<uint32_t> free_index(n, none), free_nodes;
  for (uint32_t i = 0; i < n; ++i) {
    if (model.topology.fixed[i]) continue;
    free_index[i] = static_cast<uint32_t>(free_nodes.size());
    free_nodes.push_back(i);
  }
  std::vector<Edge> free_pairs;
  free_pairs.reserve(pairs.size());
  for (const Edge &p : pairs) {
    if (free_index[p[0]] != none && free_index[p[1]] != none) {
      free_pairs.push_back({free_index[p[0]], free_index[p[1]]});
    }
  }
  const auto rows = static_cast<uint32_t>(free_nodes.size());
  const std::vector<uint32_t> order = fill_reducing_order(rows, free_pairs);
  row_of.assign(n, none);
  node_of.resize(rows);
  for (uint32_t k = 0; k < rows; ++k) {
    node_of[k] = free_nodes[order[k]];
    row_of[node_of[k]] = k;
  }
  for (Edge &p : free_pairs) p = {row_of[free_nodes[p[0]]], row_of[free_nodes[p[1]]]};
  matrix.set_pattern(rows, std::move(free_pairs));
}

}  // namespace mvs
