// Topology by sorting: the order of every list does not depend on hashing or addresses.
#include "model/topology.h"

#include <algorithm>

#include "model/sides.h"

namespace mvs::core {
namespace {

void add_edges(const std::vector<Side> &sides, Topology &topology) {
  for (const Side &side : sides) {
    if (topology.edges.empty() || topology.edges.back() != side.edge) {
      topology.edges.push_back(side.edge);
      topology.edge_triangles.push_back({side.triangle, none});
    } else {
      topology.edge_triangles.back()[1] = side.triangle;
    }
    topology.triangle_edges[side.triangle][side.k] =
        static_cast<uint32_t>(topology.edges.size() - 1);
  }
}

void add_hinges(const std::vector<Tri> &triangles, Topology &topology) {
  for (uint32_t e = 0; e < topology.edges.size(); ++e) {
    const Edge &edge = topology.edges[e], &pair = topology.edge_triangles[e];
    if (pair[1] == none) continue;
    topology.hinges.push_back({edge[0], edge[1], opposite_corner(triangles[pair[0]], edge),
                               opposite_corner(triangles[pair[1]], edge)});
    topology.hinge_edge.push_back(e);
  }
}

void add_kinds(const Valve &valve, Topology &topology) {
  const size_t n = valve.rest.size();
  topology.node_kind.assign(n, NodeKind::branch);
  topology.fixed.assign(n, 0);
  for (const Tri &triangle : valve.triangles) {
    for (const uint32_t node : triangle) topology.node_kind[node] = NodeKind::leaflet;
  }
  for (const uint32_t node : valve.annulus) topology.node_kind[node] = NodeKind::annulus;
  for (const Head &head : valve.heads) topology.node_kind[head.node] = NodeKind::head;
  for (size_t node = 0; node < n; ++node) {
    topology.fixed[node] =
        topology.node_kind[node] == NodeKind::annulus || topology.node_kind[node] == NodeKind::head;
  }
}

// Traverses the boundary in the winding of its triangles. In a manifold sheet each boundary node
// has one successor, so the loops are disjoint; the annulus is left out.
void add_free_edges(const Valve &valve, Topology &topology) {
  std::vector<uint32_t> next(valve.rest.size(), none);
  for (uint32_t t = 0; t < valve.triangles.size(); ++t) {
    for (uint32_t k = 0; k < 3; ++k) {
      if (topology.edge_triangles[topology.triangle_edges[t][k]][1] != none) continue;
      next[valve.triangles[t][k]] = valve.triangles[t][(k + 1) % 3];
    }
  }
  for (const uint32_t node : valve.annulus) next[node] = none;
  for (uint32_t first = 0; first < next.size(); ++first) {
    if (next[first] == none) continue;
    std::vector<uint32_t> loop;
    for (uint32_t node = first; next[node] != none;) {
      loop.push_back(node);
      const uint32_t after = next[node];
      next[node] = none;
      node = after;
    }
    topology.free_edges.push_back(std::move(loop));
  }
}

}  // namespace

Topology make_topology(const Valve &valve) {
  Topology topology;
  topology.triangle_edges.resize(valve.triangles.size());
  add_edges(sorted_sides(valve.triangles), topology);
  add_hinges(valve.triangles, topology);
  topology.node_triangles = rows_of(valve.rest.size(), valve.triangles.get());
  topology.node_chords = chords_at_nodes(valve);
  add_kinds(valve, topology);
  add_free_edges(valve, topology);
  return topology;
}

Rows chords_at_nodes(const Valve &valve) {
  std::vector<Edge> chords;
  chords.reserve(valve.chords.size());
  for (const Chord &chord : valve.chords) chords.push_back({chord.a, chord.b});
  return rows_of(valve.rest.size(), chords);
}

uint32_t edge_between(const Topology &topology, uint32_t a, uint32_t b) {
  const std::vector<Edge> &edges = topology.edges;
  const Edge edge = {std::min(a, b), std::max(a, b)};
  const auto found = std::lower_bound(edges.begin(), edges.end(), edge);
  return found != edges.end() && *found == edge ? static_cast<uint32_t>(found - edges.begin())
                                                : none;
}

}  // namespace mvs::core
