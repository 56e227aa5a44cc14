// What follows from the triangles: edges, neighbours, hinges, boundary loops, node kinds.
#pragma once

#include <vector>

#include "model/rows.h"
#include "model/valve.h"

namespace mvs {

struct Topology {
  std::vector<Edge> edges;           // smaller node first, sorted
  std::vector<Edge> edge_triangles;  // one or two adjacent triangles; `none` in the second place
  std::vector<Tri> triangle_edges;   // edge k of a triangle joins its corners k and k + 1
  std::vector<std::array<uint32_t, 4>> hinges;  // edge nodes i j, then the opposite corners
  std::vector<uint32_t> hinge_edge;
  Rows node_triangles;                            // triangles around each node, ascending
  Rows node_chords;                               // chord segments at each node, ascending
  std::vector<uint8_t> node_kind;                 // MVS_NODE_IS_*
  std::vector<uint8_t> fixed;                     // 1: prescribed (annulus, head)
  std::vector<std::vector<uint32_t>> free_edges;  // the other boundary loops, in order
};

Topology make_topology(const Valve &valve);

}  // namespace mvs
