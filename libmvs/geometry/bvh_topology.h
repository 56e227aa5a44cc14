// The shape of a tree over the triangles of a sheet, by halving at the median of the longest side,
// down to blocks of a few: for boxes that are placed anew as the sheet moves.
#pragma once

#include <vector>

#include "base/types.h"

namespace mvs::core {

// In depth-first order: the left child follows its parent.
struct BvhNode {
  uint32_t right;  // child, or none in a leaf
  uint32_t after;  // the first branch that is not below it
  uint32_t first;  // of its triangles, by their places in the order of the tree
};

struct BvhTopology {
  std::vector<BvhNode> branches;
  std::vector<uint32_t> order;  // of the triangles
};

// n log n, and the same on every machine; empty without triangles. All leaves but the last have
// `block` triangles.
BvhTopology make_bvh_topology(const std::vector<Vec3> &shape, const std::vector<Tri> &triangles,
                              uint32_t block);

}  // namespace mvs::core
