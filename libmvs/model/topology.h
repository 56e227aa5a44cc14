// Topology derived from the triangles: edges, adjacency, hinges, boundary loops, node kinds.
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
  Rows node_triangles;  // triangles around each node, ascending
  Rows node_chords;     // chord segments at each node, ascending
  CowVector<NodeKind> node_kind;
  CowVector<uint8_t> fixed;                     // 1: prescribed (annulus, head)
  CowVector<std::vector<uint32_t>> free_edges;  // boundary loops except the annulus, in order
};

Topology make_topology(const Valve &valve);

// Chord segments at each node, ascending.
Rows chords_at_nodes(const Valve &valve);

// The index of the edge between two nodes; `none` if the sheet has no such edge.
uint32_t edge_between(const Topology &topology, uint32_t a, uint32_t b);

// Breadth-first search over edges: the triangles connected to `first` among those that `accept`
// returns true for. Marks every triangle that it looks at in `seen` and does not look at marked
// ones.
template <typename Accept>
std::vector<uint32_t> connected_triangles(const Topology &topology, uint32_t first,
                                          std::vector<uint8_t> &seen, Accept accept) {
  std::vector<uint32_t> found = {first};
  seen[first] = 1;
  for (size_t q = 0; q < found.size(); ++q) {
    for (const uint32_t e : topology.triangle_edges[found[q]]) {
      for (const uint32_t t : topology.edge_triangles[e]) {
        if (t == none || seen[t]) continue;
        seen[t] = 1;
        if (accept(t)) found.push_back(t);
      }
    }
  }
  return found;
}

}  // namespace mvs::core
