// Symmetric sparse matrix of 3x3 blocks (BSC): the lower triangle by columns, diagonal block first.
#pragma once

#include <algorithm>
#include <vector>

#include "base/types.h"

namespace mvs::core {

class BlockMatrix {
 public:
  // Sets the pattern of `n` block rows from pairs of rows in any order, plus the diagonal.
  void set_pattern(uint32_t n, std::vector<Edge> pairs) {
    sort_pairs(n, pairs);
    take_sorted(n, pairs);
  }

  // The same from the output of sort_pairs().
  void take_sorted(uint32_t n, const std::vector<Edge> &pairs) {
    start.assign(n + 1, 0);
    make_room(row, pairs.size() + n);
    make_room(value, pairs.size() + n);
    row.clear();
    auto pair = pairs.begin();
    for (uint32_t c = 0; c < n; ++c) {
      row.push_back(c);
      for (; pair != pairs.end() && (*pair)[0] == c; ++pair) {
        if ((*pair)[1] != c) row.push_back((*pair)[1]);
      }
      start[c + 1] = static_cast<uint32_t>(row.size());
    }
    value.resize(row.size());
    clear();
  }

  // Removes all rows, and keeps their memory.
  void forget_pattern() {
    start.clear();
    row.clear();
    value.clear();
  }

  // Sorts pairs of `n` rows, the lower row first, and removes duplicates. Radix sort in linear
  // time: by the higher row, then, keeping that order, by the lower one.
  void sort_pairs(uint32_t n, std::vector<Edge> &pairs) {
    for (Edge &p : pairs) p = {std::min(p[0], p[1]), std::max(p[0], p[1])};
    make_room(pairs, pairs.size());
    halfway_.reserve(pairs.capacity());  // grows no more often than `pairs`
    halfway_.resize(pairs.size());
    for (const size_t key : {1u, 0u}) {
      count_.assign(n + 1, 0);
      for (const Edge &p : pairs) ++count_[p[key] + 1];
      for (uint32_t r = 0; r < n; ++r) count_[r + 1] += count_[r];
      for (const Edge &p : pairs) halfway_[count_[p[key]]++] = p;
      pairs.swap(halfway_);
    }
    // gcc would compare arrays by a call of memcmp
    const auto is_same = [](const Edge &a, const Edge &b) { return a[0] == b[0] && a[1] == b[1]; };
    pairs.erase(std::unique(pairs.begin(), pairs.end(), is_same), pairs.end());
  }

  void clear() { std::fill(value.begin(), value.end(), Mat3::Zero()); }

  uint32_t size() const { return start.empty() ? 0 : static_cast<uint32_t>(start.size() - 1); }

  // Returns the index of block (r, c), r >= c; `none` if it is not in the pattern.
  uint32_t find(uint32_t r, uint32_t c) const {
    const uint32_t *first = row.data() + start[c], *last = row.data() + start[c + 1];
    // binary search without branches, which the processor would mispredict
    for (size_t left = static_cast<size_t>(last - first); left > 1;) {
      const size_t half = left / 2;
      first = first[half] <= r ? first + half : first;
      left -= half;
    }
    return first != last && *first == r ? static_cast<uint32_t>(first - row.data()) : none;
  }

  std::vector<uint32_t> start, row;  // column c holds blocks start[c] .. start[c + 1]
  std::vector<Mat3> value;

 private:
  // buffers of sort_pairs(): pairs after the first pass, counts of each row
  std::vector<Edge> halfway_;
  std::vector<uint32_t> count_;
};

}  // namespace mvs::core
