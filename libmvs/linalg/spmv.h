// Products of a BlockMatrix with vectors, by the widest registers that the processor has.
#pragma once

#include "linalg/block_matrix.h"

namespace mvs::core {

// Keeps the memory that a product takes. The bits are the same on every processor, and entries that
// are zero change none but signs of zeros.
class BlockSpmv {
 public:
  // y = A v
  void multiply(const BlockMatrix &a, const std::vector<Vec3> &v, std::vector<Vec3> &y);

 private:
  std::vector<double> v_, y_;  // a row in four numbers, of which the last is nobody's
};

}  // namespace mvs::core
