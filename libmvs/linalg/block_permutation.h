// A matrix of 3x3 blocks in another order of its rows.
#pragma once

#include <vector>

#include "linalg/block_matrix.h"

namespace mvs::core {

// Its memory is kept from one matrix to the next.
class BlockPermutation {
 public:
  // Row r of `from` becomes row to[r] of `result`, whose pattern has nothing that is zero but on
  // the diagonal.
  void permute(const BlockMatrix &from, const std::vector<uint32_t> &to, BlockMatrix &result);

 private:
  struct Block {
    uint32_t column, row;
    uint32_t source;  // in `from`
    bool turned;      // its transpose
  };
  void take(const BlockMatrix &from, const std::vector<uint32_t> &to);
  template <typename Key>
  void sort_by(uint32_t rows, Key key);

  std::vector<Block> blocks_, sorted_;
  std::vector<uint32_t> count_;
};

}  // namespace mvs::core
