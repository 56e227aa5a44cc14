// The shape of a tree over the triangles of a sheet, by halving at the median of the longest side:
// for boxes that are placed anew as the sheet moves.
#pragma once

#include <vector>

#include "base/types.h"

namespace mvs {

// In depth-first order: the left child follows its parent.
struct SheetBranch {
  uint32_t right;     // child, or none in a leaf
  uint32_t after;     // the first node that is not below it
  uint32_t triangle;  // of a leaf
};

// n log n, and the same on every machine; empty without triangles.
std::vector<SheetBranch> sheet_tree(const std::vector<Vec3> &shape,
                                    const std::vector<Tri> &triangles);

}  // namespace mvs
