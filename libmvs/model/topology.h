// What follows from the triangles: edges, neighbours, hinges, boundary loops, node kinds.
#pragma once

#include <vector>

#include "model/compressed_rows.h"
#include "model/valve.h"

namespace mvs::core {

struct Topology {
  CowVector<Edge> edges;           // smaller node first, sorted
  CowVector<Edge> edge_triangles;  // one or two adjacent triangles; `none` in the second place
  CowVector<Tri> triangle_edges;   // edge k of a triangle joins its corners k and k + 1
  CowVector<std::array<uint32_t, 4>> hinges;  // edge nodes i j, then the opposite corners
  CowVector<uint32_t> hinge_edge;
  Rows node_triangles;                          // triangles around each node, ascending
  Rows node_chords;                             // chord segments at each node, ascending
  CowVector<uint8_t> node_kind;                 // MVS_NODE_KIND_*
  CowVector<uint8_t> fixed;                     // 1: prescribed (annulus, head)
  CowVector<std::vector<uint32_t>> free_edges;  // the other boundary loops, in order
};

Topology make_topology(const Valve &valve);

}  // namespace mvs::core
