// Compressed rows: for each node, the groups (triangles, chord segments) that hold it.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "base/cow_vector.h"
#include "base/types.h"

namespace mvs::core {

// Row r holds items[start[r] .. start[r + 1]).
struct Rows {
  CowVector<uint32_t> start, items;

  std::span<const uint32_t> operator[](size_t row) const {
    return {items.data() + start[row], items.data() + start[row + 1]};
  }
};

// Rows of nodes over groups, ascending; a group is an array of nodes.
template <typename Group>
Rows rows_of(size_t node_count, const std::vector<Group> &groups) {
  std::vector<uint32_t> start(node_count + 1, 0);
  for (const Group &group : groups) {
    for (const uint32_t node : group) ++start[node + 1];
  }
  for (size_t n = 0; n < node_count; ++n) start[n + 1] += start[n];
  std::vector<uint32_t> items(start.back()), next(start.begin(), start.end() - 1);
  for (uint32_t g = 0; g < groups.size(); ++g) {
    for (const uint32_t node : groups[g]) items[next[node]++] = g;
  }
  return {std::move(start), std::move(items)};
}

}  // namespace mvs::core
