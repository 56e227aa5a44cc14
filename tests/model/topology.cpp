// Topology of the hand-made valve against known counts and against brute force.
#include <doctest/doctest.h>
#include <algorithm>
#include <set>

#include "model/model.h"
#include "tests/model/small_valve.h"

using namespace mvs::core;

TEST_CASE("euler_number_and_counts_of_the_small_valve") {
  const Valve valve = small_valve();
  const Topology topology = make_topology(valve);
  const size_t sheet_nodes = small_rows * small_segments;
  // a sheet with two rims, like a ring: vertices - edges + faces = 0
  CHECK(sheet_nodes + valve.triangles.size() == topology.edges.size());
  CHECK(topology.hinges.size() == topology.edges.size() - 2 * small_segments);
  CHECK(topology.hinge_edge.size() == topology.hinges.size());
  CHECK(std::is_sorted(topology.edges.begin(), topology.edges.end()));
  CHECK(std::set<Edge>(topology.edges.begin(), topology.edges.end()).size() ==
        topology.edges.size());
}

TEST_CASE("triangle_edges_join_their_corners") {
  const Valve valve = small_valve();
  const Topology topology = make_topology(valve);
  for (uint32_t t = 0; t < valve.triangles.size(); ++t) {
    for (uint32_t k = 0; k < 3; ++k) {
      const uint32_t a = valve.triangles[t][k], b = valve.triangles[t][(k + 1) % 3];
      const uint32_t e = topology.triangle_edges[t][k];
      CHECK(topology.edges[e] == Edge{std::min(a, b), std::max(a, b)});
      const Edge &pair = topology.edge_triangles[e];
      CHECK((pair[0] == t || pair[1] == t));
      CHECK(pair[0] < pair[1]);
    }
  }
}

TEST_CASE("hinges_are_two_triangles_over_one_edge") {
  const Valve valve = small_valve();
  const Topology topology = make_topology(valve);
  for (size_t h = 0; h < topology.hinges.size(); ++h) {
    const std::array<uint32_t, 4> &hinge = topology.hinges[h];
    const Edge &edge = topology.edges[topology.hinge_edge[h]];
    const Edge &pair = topology.edge_triangles[topology.hinge_edge[h]];
    CHECK(edge == Edge{hinge[0], hinge[1]});
    for (int side = 0; side < 2; ++side) {
      const Tri &triangle = valve.triangles[pair[side]];
      const std::set<uint32_t> expected = {hinge[0], hinge[1], hinge[2 + side]};
      CHECK(std::set<uint32_t>(triangle.begin(), triangle.end()) == expected);
    }
  }
}

TEST_CASE("rows_list_every_triangle_and_chord_of_a_node_in_order") {
  const Valve valve = small_valve();
  const Topology topology = make_topology(valve);
  for (uint32_t n = 0; n < valve.rest.size(); ++n) {
    std::vector<uint32_t> triangles, chords;
    for (uint32_t t = 0; t < valve.triangles.size(); ++t) {
      if (std::count(valve.triangles[t].begin(), valve.triangles[t].end(), n)) {
        triangles.push_back(t);
      }
    }
    for (uint32_t c = 0; c < valve.chords.size(); ++c) {
      if (valve.chords[c].a == n || valve.chords[c].b == n) chords.push_back(c);
    }
    const auto row = [n](const Rows &rows) {
      return std::vector<uint32_t>(rows.items.begin() + rows.start[n],
                                   rows.items.begin() + rows.start[n + 1]);
    };
    CHECK(row(topology.node_triangles) == triangles);
    CHECK(row(topology.node_chords) == chords);
  }
}

TEST_CASE("nodes_have_their_kind_and_prescribed_nodes_are_annulus_and_heads") {
  const Valve valve = small_valve();
  const Topology topology = make_topology(valve);
  const uint32_t sheet = small_rows * small_segments;
  for (uint32_t n = 0; n < valve.rest.size(); ++n) {
    const NodeKind kind = n < small_segments ? NodeKind::annulus
                          : n < sheet        ? NodeKind::leaflet
                          : n % 2 == 0       ? NodeKind::head
                                             : NodeKind::branch;
    CHECK(topology.node_kind[n] == kind);
    CHECK(topology.fixed[n] == (kind == NodeKind::annulus || kind == NodeKind::head));
  }
}

TEST_CASE("the_free_edge_is_the_lower_rim_in_order") {
  const Topology topology = make_topology(small_valve());
  REQUIRE(topology.free_edges.size() == 1);
  const std::vector<uint32_t> &loop = topology.free_edges[0];
  REQUIRE(loop.size() == small_segments);
  for (size_t k = 0; k < loop.size(); ++k) {
    CHECK(loop[k] >= (small_rows - 1) * small_segments);
    const uint32_t after = loop[(k + 1) % loop.size()];
    const uint32_t step = (small_segments + after - loop[k]) % small_segments;
    CHECK((step == 1 || step == small_segments - 1));
  }
}
