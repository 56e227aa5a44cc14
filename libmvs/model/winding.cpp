// Propagates the winding of one triangle over its component by breadth-first search.
#include "model/winding.h"

namespace mvs::core {
namespace {

struct Neighbour {
  uint32_t triangle = none;
  bool same_direction = false;  // both traverse the edge in one direction: one is wrong
};
using Neighbours = std::vector<std::array<Neighbour, 3>>;

Neighbours neighbours_of(const std::vector<Tri> &triangles, const std::vector<Side> &sides) {
  Neighbours neighbours(triangles.size());
  for_each_edge(sides, [&](size_t first, size_t last) {
    if (last - first != 2) return;
    const Side &l = sides[first], &r = sides[first + 1];
    const bool same_direction = side_from(triangles, l) == side_from(triangles, r);
    neighbours[l.triangle][l.k] = {r.triangle, same_direction};
    neighbours[r.triangle][r.k] = {l.triangle, same_direction};
  });
  return neighbours;
}

void propagate(const Neighbours &neighbours, uint32_t first, Winding &winding) {
  std::vector<uint32_t> queue = {first};
  winding.component[first] = winding.component_count;
  for (size_t q = 0; q < queue.size(); ++q) {
    const uint32_t t = queue[q];
    for (const Neighbour &neighbour : neighbours[t]) {
      if (neighbour.triangle == none || winding.component[neighbour.triangle] != none) continue;
      winding.component[neighbour.triangle] = winding.component_count;
      winding.against[neighbour.triangle] = winding.against[t] != neighbour.same_direction;
      queue.push_back(neighbour.triangle);
    }
  }
  ++winding.component_count;
}

}  // namespace

Winding find_winding(const std::vector<Tri> &triangles, const std::vector<Side> &sides) {
  const Neighbours neighbours = neighbours_of(triangles, sides);
  Winding winding;
  winding.component.assign(triangles.size(), none);
  winding.against.assign(triangles.size(), 0);
  for (uint32_t t = 0; t < triangles.size(); ++t) {
    if (winding.component[t] == none) propagate(neighbours, t, winding);
  }
  for (const Side &side : sides) {
    const Neighbour &neighbour = neighbours[side.triangle][side.k];
    if (neighbour.triangle == none || neighbour.triangle < side.triangle) continue;
    const bool differ = winding.against[side.triangle] != winding.against[neighbour.triangle];
    if (differ != neighbour.same_direction) winding.conflicts.push_back(side.edge);
  }
  return winding;
}

}  // namespace mvs::core
