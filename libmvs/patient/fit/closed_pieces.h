// Connected pieces of a closed surface, each wound alike.
//
// The leaflets of a closed valve come as a surface each, from labels and from other programs, and
// each is wound as it happens: which side of a piece faces the atrium is a question of its own.
#pragma once

#include <vector>

#include "base/types.h"

namespace mvs::core {

struct ClosedPieces {
  std::vector<uint32_t> of_triangle;  // pieces are numbered from 0
  std::vector<uint8_t> turned;        // triangles that are wound the other way than their piece
  uint32_t count = 0;
  std::vector<uint32_t> vertex;  // of each point: the first of those that are one vertex with it

  // A triangle with corners in common with its neighbours.
  Tri joined(const Tri &t) const { return {vertex[t[0]], vertex[t[1]], vertex[t[2]]}; }
};

// Triangles are joined across sides whose points are equal, also if the points are repeated
// (triangle soup). Those without area are pieces of their own, as are those with a side shorter
// than 1/1000 of the median. Of a Moebius band no triangle is marked.
ClosedPieces closed_pieces(const std::vector<Vec3> &points, const std::vector<Tri> &triangles);

}  // namespace mvs::core
