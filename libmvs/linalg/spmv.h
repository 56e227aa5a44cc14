// Sparse matrix-vector product (SpMV) of a symmetric BlockMatrix, with SIMD.
#pragma once

#include "linalg/block_matrix.h"

namespace mvs::core {

// Keeps its memory from one product to the next. The bits are the same on every processor, and
// blocks that are zero change only signs of zeros.
class BlockSpmv {
 public:
  // y = A v
  void multiply(const BlockMatrix &a, const std::vector<Vec3> &v, std::vector<Vec3> &y);

 private:
  std::vector<double> v_, y_;  // rows of four numbers, the last one padding
};

}  // namespace mvs::core
