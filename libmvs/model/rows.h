// Compressed rows: for each node, the groups (triangles, chord segments) that hold it.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "base/types.h"

namespace mvs {

// Row r holds items[start[r] .. start[r + 1]).
struct Rows {
  std::vector<uint32_t> start, items;

  std::span<const uint32_t> operator[](size_t row) const {
    return {items.data() + start[row], items.data() + start[row + 1]};
  }
};

// Rows of nodes over groups, ascending; a group is an array of nodes.
template <typename Group>
Rows rows_of(size_t node_count, const std::vector<Group> &groups) {
  Rows rows;
  rows.start.assign(node_count + 1, 0);
  for (const Group &group : groups) {
    for (const uint32_t node : group) ++rows.start[node + 1];
  }
  for (size_t n = 0; n < node_count; ++n) rows.start[n + 1] += rows.start[n];
  rows.items.resize(rows.start.back());
  std::vector<uint32_t> next(rows.start.begin(), rows.start.end() - 1);
  for (uint32_t g = 0; g < groups.size(); ++g) {
    for (const uint32_t node : groups[g]) rows.items[next[node]++] = g;
  }
  return rows;
}

}  // namespace mvs
