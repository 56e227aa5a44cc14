// Dijkstra's tree from a vertex, a maximum spanning cotree, the edges that are left.
#include "patient/surface/shortest_loops.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <queue>

#include "model/sides.h"
#include "patient/surface/boundary.h"
#include "patient/surface/clusters.h"

namespace mvs::core {
namespace {

// An edge of the surface, with the faces on both sides: triangles, or a boundary loop as a face
// behind them.
struct SurfaceEdge {
  Edge edge;
  std::array<uint32_t, 2> face;
  double length;
};

struct EdgeGraph {
  std::vector<SurfaceEdge> edges;
  std::vector<std::vector<uint32_t>> around;  // edges of each vertex
  std::vector<uint8_t> at_boundary;           // of each vertex
  size_t faces = 0;
};

EdgeGraph graph_of(const LeafletSheet &surface) {
  EdgeGraph graph;
  const size_t n = surface.x.size();
  graph.at_boundary.assign(n, 0);
  std::vector<uint32_t> loop_of(n, none);
  uint32_t loops = 0;
  for (const std::vector<uint32_t> &loop : boundary_loops(surface)) {
    for (const uint32_t i : loop) {
      loop_of[i] = loops;
      graph.at_boundary[i] = 1;
    }
    ++loops;
  }
  const uint32_t triangles = static_cast<uint32_t>(surface.triangles.size());
  graph.faces = triangles + loops;
  graph.around.resize(n);
  const std::vector<Side> sides = sorted_sides(surface.triangles);
  for_each_edge(sides, [&](size_t first, size_t last) {
    const Edge &e = sides[first].edge;
    const uint32_t other = last - first > 1 ? sides[first + 1].triangle : triangles + loop_of[e[0]];
    const uint32_t index = static_cast<uint32_t>(graph.edges.size());
    graph.edges.push_back(
        {e, {sides[first].triangle, other}, (surface.x[e[1]] - surface.x[e[0]]).norm()});
    for (const uint32_t i : e) graph.around[i].push_back(index);
  });
  return graph;
}

// Shortest paths from a vertex (Dijkstra 1959) that do not meet the boundary.
struct PathTree {
  std::vector<double> distance;  // m; infinite: beyond the reach
  std::vector<uint32_t> edge;    // towards the root; none at it
};

PathTree paths_from(const EdgeGraph &graph, uint32_t root, double reach) {
  const size_t n = graph.around.size();
  PathTree tree{std::vector<double>(n, INFINITY), std::vector<uint32_t>(n, none)};
  using Entry = std::pair<double, uint32_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  tree.distance[root] = 0;
  open.push({0, root});
  while (!open.empty()) {
    const auto [distance, i] = open.top();
    open.pop();
    if (distance > tree.distance[i]) continue;
    for (const uint32_t e : graph.around[i]) {
      const SurfaceEdge &edge = graph.edges[e];
      const uint32_t j = edge.edge[0] == i ? edge.edge[1] : edge.edge[0];
      const double there = distance + edge.length;
      if (graph.at_boundary[j] != 0 || there > reach || there >= tree.distance[j]) continue;
      tree.distance[j] = there;
      tree.edge[j] = e;
      open.push({there, j});
    }
  }
  return tree;
}

// The loop from the root along the tree to an edge, over it, and back; without the path that both
// ways share.
SurfaceLoop loop_over(const EdgeGraph &graph, const PathTree &tree, uint32_t edge) {
  const auto path = [&](uint32_t i) {
    std::vector<uint32_t> to_root = {i};
    while (tree.edge[i] != none) {
      const Edge &e = graph.edges[tree.edge[i]].edge;
      i = e[0] == i ? e[1] : e[0];
      to_root.push_back(i);
    }
    return to_root;
  };
  const auto [a, b] = graph.edges[edge].edge;
  std::vector<uint32_t> left = path(a), right = path(b);
  while (left.size() > 1 && right.size() > 1 && left[left.size() - 2] == right[right.size() - 2]) {
    left.pop_back();
    right.pop_back();
  }
  SurfaceLoop loop;
  loop.vertices = left;
  loop.vertices.insert(loop.vertices.end(), right.rbegin() + 1, right.rend());
  const double shared = tree.distance[left.back()];
  loop.length = tree.distance[a] + tree.distance[b] + graph.edges[edge].length - 2 * shared;
  return loop;
}

// The edges that are in neither the tree of paths nor a cotree that takes edges of long loops
// first. Loops beyond the reach of the tree count as infinitely long.
std::vector<uint32_t> edges_left(const EdgeGraph &graph, const PathTree &tree, double longest) {
  std::vector<uint8_t> in_tree(graph.edges.size(), 0);
  for (const uint32_t e : tree.edge) {
    if (e != none) in_tree[e] = 1;
  }
  std::vector<uint32_t> faces(graph.faces);
  std::iota(faces.begin(), faces.end(), 0u);
  std::vector<std::pair<double, uint32_t>> short_loops;
  for (uint32_t e = 0; e < graph.edges.size(); ++e) {
    if (in_tree[e] != 0) continue;
    const SurfaceEdge &edge = graph.edges[e];
    const double length = tree.distance[edge.edge[0]] + tree.distance[edge.edge[1]] + edge.length;
    if (length <= longest) {
      short_loops.push_back({-length, e});
    } else {
      join(faces, edge.face[0], edge.face[1]);
    }
  }
  std::sort(short_loops.begin(), short_loops.end());
  std::vector<uint32_t> left;
  for (const auto &[length, e] : short_loops) {
    const std::array<uint32_t, 2> &face = graph.edges[e].face;
    if (!join(faces, face[0], face[1])) left.push_back(e);
  }
  return left;
}

}  // namespace

size_t handle_count(const LeafletSheet &surface, size_t boundaries) {
  size_t edges = 0;
  const std::vector<Side> sides = sorted_sides(surface.triangles);
  for_each_edge(sides, [&](size_t, size_t) { ++edges; });
  // Euler and Poincare: V - E + F = 2 - 2 handles - boundaries
  const auto characteristic = static_cast<long>(surface.x.size()) - static_cast<long>(edges) +
                              static_cast<long>(surface.triangles.size());
  const long twice = 2 - static_cast<long>(boundaries) - characteristic;
  return twice > 0 ? static_cast<size_t>(twice / 2) : 0;
}

std::vector<SurfaceLoop> shortest_loops(const LeafletSheet &surface, double longest) {
  const EdgeGraph graph = graph_of(surface);
  const size_t n = surface.x.size();
  uint32_t start = 0;
  while (start < n && graph.at_boundary[start] != 0) ++start;
  std::vector<SurfaceLoop> found;
  if (start == n) return found;
  // every loop that does not separate the surface crosses one of any basis
  const PathTree tree = paths_from(graph, start, INFINITY);
  std::vector<uint8_t> near(n, 0);
  for (const uint32_t e : edges_left(graph, tree, INFINITY)) {
    for (const uint32_t i : loop_over(graph, tree, e).vertices) near[i] = 1;
  }
  for (uint32_t i = 0; i < n; ++i) {
    if (near[i] == 0) continue;
    const PathTree around = paths_from(graph, i, 0.5 * longest);
    for (const uint32_t e : edges_left(graph, around, longest)) {
      found.push_back(loop_over(graph, around, e));
    }
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const SurfaceLoop &a, const SurfaceLoop &b) { return a.length < b.length; });
  return found;
}

}  // namespace mvs::core
