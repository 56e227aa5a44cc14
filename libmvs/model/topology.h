// What follows from the triangles: edges, neighbours, hinges, boundary loops, node kinds.
#pragma once

#include <vector>

#include "model/compressed_rows.h"
#include "model/valve.h"

namespace mvs::core {

struct Topology {
  SharedVector<Edge> edges;           // smaller node first, sorted
  SharedVector<Edge> edge_triangles;  // one or two adjacent triangles; `none` in the second place
  SharedVector<Tri> triangle_edges;   // edge k of a triangle joins its corners k and k + 1
  SharedVector<std::array<uint32_t, 4>> hinges;  // edge nodes i j, then the opposite corners
  SharedVector<uint32_t> hinge_edge;
  Rows node_triangles;                             // triangles around each node, ascending
  Rows node_chords;                                // chord segments at each node, ascending
  SharedVector<uint8_t> node_kind;                 // MVS_NODE_IS_*
  SharedVector<uint8_t> fixed;                     // 1: prescribed (annulus, head)
  SharedVector<std::vector<uint32_t>> free_edges;  // the other boundary loops, in order
};

Topology make_topology(const Valve &valve);

}  // namespace mvs::core
