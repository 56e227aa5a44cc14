// Elimination order by geometric nested dissection (George, SIAM J. Numer. Anal. 10, 1973), for
// graphs whose nodes have positions and few long edges.
//
// A plane across the longest extent of a part halves its nodes. The minimum vertex cover of the
// edges across it separates the halves and is eliminated after them (it has the size of a maximum
// matching of these edges: Koenig, 1931). Small parts are ordered by minimum degree. On large
// irregular meshes a factor has 0.6 of the work of minimum degree alone; on regular ones, or if the
// plane crosses the rows of a mesh, it may have more: elimination_work() compares them.
#pragma once

#include <vector>

#include "base/types.h"

namespace mvs::core {

// order[k] is the node eliminated k-th; pairs of nodes may occur more than once.
std::vector<uint32_t> nested_dissection_order(const std::vector<Edge> &pairs,
                                              const std::vector<Vec3> &place);

// Returns about how many products of blocks a factorisation in this order has: the sum of the
// squares of its column counts (as in Davis, ACM Trans. Math. Softw. 31, 2005).
double elimination_work(const std::vector<uint32_t> &order, const std::vector<Edge> &pairs);

}  // namespace mvs::core
