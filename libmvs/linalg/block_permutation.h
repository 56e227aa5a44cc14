// Symmetric permutation of a matrix of 3x3 blocks.
#pragma once

#include <vector>

#include "linalg/block_matrix.h"

namespace mvs::core {

// Keeps its memory from one matrix to the next.
class BlockPermutation {
 public:
  // Row r of `from` becomes row to[r] of `result`. Blocks that are zero are left out of the
  // pattern, except on the diagonal.
  void permute(const BlockMatrix &from, const std::vector<uint32_t> &to, BlockMatrix &result);

 private:
  struct Block {
    uint32_t column, row;
    uint32_t source;  // in `from`
    bool turned;      // transposed
  };
  void take(const BlockMatrix &from, const std::vector<uint32_t> &to);
  template <typename Key>
  void sort_by(uint32_t rows, Key key);

  std::vector<Block> blocks_, sorted_;
  std::vector<uint32_t> count_;
};

}  // namespace mvs::core
