// Collects and sorts the sides of triangles.
#include "model/sides.h"

#include <algorithm>

namespace mvs::core {

namespace {

// Sorts by one node of the edge, stable; `start` has the first place of each node.
void sort_by_node(const std::vector<Side> &from, int node, std::vector<uint32_t> &start,
                  std::vector<Side> &to) {
  std::fill(start.begin(), start.end(), 0);
  for (const Side &side : from) ++start[side.edge[node] + 1];
  for (size_t i = 1; i < start.size(); ++i) start[i] += start[i - 1];
  for (const Side &side : from) to[start[side.edge[node]]++] = side;
}

}  // namespace

std::vector<Side> sorted_sides(const std::vector<Tri> &triangles) {
  std::vector<Side> sides;
  sides.reserve(3 * triangles.size());
  uint32_t largest = 0;
  for (uint32_t t = 0; t < triangles.size(); ++t) {
    for (uint32_t k = 0; k < 3; ++k) {
      const uint32_t a = triangles[t][k], b = triangles[t][(k + 1) % 3];
      sides.push_back({{std::min(a, b), std::max(a, b)}, t, k});
      largest = std::max({largest, a, b});
    }
  }
  // few triangles of many nodes, or of nodes that do not exist
  if (largest / 8 > triangles.size()) {
    std::sort(sides.begin(), sides.end(), [](const Side &l, const Side &r) {
      return l.edge != r.edge ? l.edge < r.edge : l.triangle < r.triangle;
    });
    return sides;
  }
  std::vector<uint32_t> start(size_t(largest) + 2);
  std::vector<Side> by_second(sides.size());
  sort_by_node(sides, 1, start, by_second);
  sort_by_node(by_second, 0, start, sides);
  return sides;
}

// Few neighbours: each is put into its place among those before.
std::vector<uint32_t> neighbours_in(const std::vector<Tri> &triangles,
                                    std::span<const uint32_t> star, uint32_t vertex) {
  std::vector<uint32_t> around;
  around.reserve(star.size() + 1);
  for (const uint32_t t : star) {
    for (const uint32_t corner : triangles[t]) {
      if (corner == vertex) continue;
      auto at = around.end();
      while (at != around.begin() && *(at - 1) > corner) --at;
      if (at == around.begin() || *(at - 1) != corner) around.insert(at, corner);
    }
  }
  return around;
}

}  // namespace mvs::core
