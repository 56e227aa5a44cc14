// The sides of all triangles, sorted so that those of one edge stand together.
#pragma once

#include <vector>

#include "base/types.h"

namespace mvs::core {

// Side k of a triangle runs from its corner k to its corner k + 1.
struct Side {
  Edge edge;  // smaller node first
  uint32_t triangle, k;
};

// Sorted by edge, then triangle.
std::vector<Side> sorted_sides(const std::vector<Tri> &triangles);

inline uint32_t side_from(const std::vector<Tri> &triangles, const Side &side) {
  return triangles[side.triangle][side.k];
}
inline uint32_t side_to(const std::vector<Tri> &triangles, const Side &side) {
  return triangles[side.triangle][(side.k + 1) % 3];
}

// Calls visit(first, last) for the run of sides of each edge.
template <typename Visit>
void for_each_edge(const std::vector<Side> &sides, Visit visit) {
  for (size_t first = 0; first < sides.size();) {
    size_t last = first + 1;
    while (last < sides.size() && sides[last].edge == sides[first].edge) ++last;
    visit(first, last);
    first = last;
  }
}

}  // namespace mvs::core
