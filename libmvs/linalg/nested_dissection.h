// An elimination order by nested dissection (George, SIAM J. Numer. Anal. 10, 1973), for graphs
// whose nodes have places and few long edges.
//
// A plane across the longest extent of a part halves its nodes; the least set of nodes that meets
// every edge across it separates the halves and is eliminated after them (as many as a largest
// matching of these edges has: Koenig, 1931). Small parts go by minimum degree. On large irregular
// meshes a factor has 0.6 of the work that minimum degree alone leaves; on regular ones, or if the
// plane runs across the rows of a mesh, it may have more: compare them by elimination_work().
#pragma once

#include <vector>

#include "base/types.h"

namespace mvs::core {

// order[k] is the node eliminated k-th; pairs of nodes may come more than once.
std::vector<uint32_t> nested_dissection_order(const std::vector<Edge> &pairs,
                                              const std::vector<Vec3> &place);

// Products of blocks, about, that a factorisation in this order has: the sum of the squares of its
// columns (counted as in Davis, ACM Trans. Math. Softw. 31, 2005).
double elimination_work(const std::vector<uint32_t> &order, const std::vector<Edge> &pairs);

}  // namespace mvs::core
