// Sorted columns of the permuted lower triangle.
#include "linalg/block_permutation.h"

namespace mvs::core {

void BlockPermutation::permute(const BlockMatrix &from, const std::vector<uint32_t> &to,
                               BlockMatrix &result) {
  const uint32_t n = from.size();
  take(from, to);
  // by columns, and within each by rows, the diagonal first
  sort_by(n, [](const Block &b) { return b.row; });
  sort_by(n, [](const Block &b) { return b.column; });
  make_room(result.row, from.row.size());
  make_room(result.value, from.row.size());
  result.start.assign(n + 1, 0);
  result.row.resize(blocks_.size());
  result.value.resize(blocks_.size());
  for (uint32_t k = 0; k < blocks_.size(); ++k) {
    const Block &b = blocks_[k];
    const Mat3 &value = from.value[b.source];
    result.start[b.column + 1] = k + 1;
    result.row[k] = b.row;
    if (b.turned) {
      result.value[k] = value.transpose();
    } else {
      result.value[k] = value;
    }
  }
}

void BlockPermutation::take(const BlockMatrix &from, const std::vector<uint32_t> &to) {
  blocks_.clear();
  make_room(blocks_, from.row.size());
  for (uint32_t c = 0; c < from.size(); ++c) {
    const uint32_t column = to[c];
    for (uint32_t k = from.start[c]; k < from.start[c + 1]; ++k) {
      if (k > from.start[c] && from.value[k].isZero(0)) continue;
      const uint32_t row = to[from.row[k]];
      blocks_.push_back({std::min(column, row), std::max(column, row), k, row < column});
    }
  }
}

// Stable counting sort.
template <typename Key>
void BlockPermutation::sort_by(uint32_t rows, Key key) {
  count_.assign(rows + 1, 0);
  for (const Block &b : blocks_) ++count_[key(b) + 1];
  for (uint32_t r = 0; r < rows; ++r) count_[r + 1] += count_[r];
  make_room(sorted_, blocks_.size());
  sorted_.resize(blocks_.size());
  for (const Block &b : blocks_) sorted_[count_[key(b)]++] = b;
  blocks_.swap(sorted_);
}

}  // namespace mvs::core
