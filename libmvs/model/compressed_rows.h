// Compressed sparse rows: for each node, the groups (triangles, chord segments) that contain it.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "base/cow_vector.h"
#include "base/types.h"

namespace mvs::core {

// Row r is items[start[r] .. start[r + 1]).
struct Rows {
  CowVector<uint32_t> start, items;

  std::span<const uint32_t> operator[](size_t row) const {
    return {items.data() + start[row], items.data() + start[row + 1]};
  }
};

// Builds rows by counting sort; for_each(visit) calls visit(row, item) for every entry, and runs
// twice.
template <typename ForEach>
Rows build_rows(size_t row_count, ForEach for_each) {
  std::vector<uint32_t> start(row_count + 1, 0);
  for_each([&](size_t row, uint32_t) { ++start[row + 1]; });
  for (size_t r = 0; r < row_count; ++r) start[r + 1] += start[r];
  std::vector<uint32_t> items(start.back()), next(start.begin(), start.end() - 1);
  for_each([&](size_t row, uint32_t item) { items[next[row]++] = item; });
  return {std::move(start), std::move(items)};
}

// Returns for each node the indices of its groups, ascending; a group is an array of nodes.
template <typename Group>
Rows rows_of(size_t node_count, const std::vector<Group> &groups) {
  return build_rows(node_count, [&](auto visit) {
    for (uint32_t g = 0; g < groups.size(); ++g) {
      for (const uint32_t node : groups[g]) visit(node, g);
    }
  });
}

}  // namespace mvs::core
