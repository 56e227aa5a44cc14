// Sharp edges, joined at their ends.
#include "patient/skin/skin_ridges.h"

#include <numeric>

#include "geometry/aabb.h"
#include "model/sides.h"
#include "patient/surface/clusters.h"

namespace mvs::core {
namespace {

constexpr double sharp = 0.5;        // cosine of 60 degrees
constexpr double least_length = 10;  // over the thickness
// Length of all chains over the extent of the valve: four chains of 2 to 3 extents each.
constexpr double least_extents = 4;
// Share of their vertices that have two of their edges: steps of voxels branch.
constexpr double least_inside = 0.7;

std::vector<Edge> sharp_edges(const LeafletSheet &skin) {
  const std::vector<Side> sides = sorted_sides(skin.triangles);
  std::vector<Edge> edges;
  for_each_edge(sides, [&](size_t first, size_t last) {
    if (last - first != 2) return;
    const Vec3 a = area_normal(skin.x, skin.triangles[sides[first].triangle]);
    const Vec3 b = area_normal(skin.x, skin.triangles[sides[first + 1].triangle]);
    if (a.dot(b) < sharp * a.norm() * b.norm()) edges.push_back(sides[first].edge);
  });
  return edges;
}

}  // namespace

SkinRidges skin_ridges(const LeafletSheet &skin, double thickness) {
  const size_t n = skin.x.size();
  const std::vector<Edge> edges = sharp_edges(skin);
  std::vector<uint32_t> parent(n);
  std::iota(parent.begin(), parent.end(), 0u);
  for (const auto &[a, b] : edges) join(parent, a, b);
  std::vector<double> length(n, 0);
  for (const auto &[a, b] : edges) {
    length[root_of(parent, a)] += (skin.x[a] - skin.x[b]).norm();
  }
  SkinRidges ridges;
  ridges.along.assign(n, {none, none});
  std::vector<uint32_t> count(n, 0);
  double all = 0;
  for (const auto &[a, b] : edges) {
    if (length[root_of(parent, a)] < least_length * thickness) continue;
    all += (skin.x[a] - skin.x[b]).norm();
    for (const auto &[from, to] : {Edge{a, b}, Edge{b, a}}) {
      if (count[from] < 2) ridges.along[from][count[from]] = to;
      ++count[from];
    }
  }
  size_t on_chains = 0, inside = 0;
  for (size_t i = 0; i < n; ++i) {
    on_chains += count[i] > 0;
    inside += count[i] == 2;
    if (count[i] != 2) ridges.along[i] = {none, none};
  }
  Aabb box;
  for (const Vec3 &p : skin.x) box.add(p);
  ridges.at_rims = all > least_extents * box.longest_side() &&
                   static_cast<double>(inside) > least_inside * static_cast<double>(on_chains);
  return ridges;
}

}  // namespace mvs::core
