// Points on edges, then polygons of three or four corners.
#include "patient/surface/level_cut.h"

#include <algorithm>
#include <map>

#include "model/sides.h"

namespace mvs::core {
namespace {

std::vector<Edge> edges_of(const std::vector<Tri> &triangles) {
  std::vector<Edge> edges;
  const std::vector<Side> sides = sorted_sides(triangles);
  for_each_edge(sides, [&](size_t first, size_t) { edges.push_back(sides[first].edge); });
  return edges;
}

// Sets the level to zero at vertices that it passes closely.
void snap_to_level(const std::vector<Edge> &edges, double snap, std::vector<double> &level) {
  std::vector<uint8_t> passed(level.size(), 0);
  for (const auto &[a, b] : edges) {
    if (level[a] * level[b] >= 0) continue;
    const double share = level[a] / (level[a] - level[b]);
    if (share < snap) passed[a] = 1;
    if (share > 1 - snap) passed[b] = 1;
  }
  for (size_t i = 0; i < level.size(); ++i) {
    if (passed[i] != 0) level[i] = 0;
  }
}

// The sheet with new vertices where edges cross the level, and their numbers.
struct DividedEdges {
  LeafletSheet sheet;
  std::map<Edge, uint32_t> middle;
};

DividedEdges divide_edges(const LeafletSheet &sheet, const std::vector<Edge> &edges,
                          const std::vector<double> &level) {
  DividedEdges divided{sheet, {}};
  LeafletSheet &made = divided.sheet;
  for (const Edge &edge : edges) {
    const auto [a, b] = edge;
    if (level[a] * level[b] >= 0) continue;
    const double share = level[a] / (level[a] - level[b]);
    divided.middle[edge] = static_cast<uint32_t>(made.x.size());
    made.x.emplace_back(made.x[a] + share * (made.x[b] - made.x[a]));
    if (!made.thickness.empty()) {
      made.thickness.push_back(made.thickness[a] + share * (made.thickness[b] - made.thickness[a]));
    }
  }
  return divided;
}

// The corners of the part of a triangle that is not above the level.
std::vector<uint32_t> polygon_below(const Tri &t, const std::vector<double> &level,
                                    const std::map<Edge, uint32_t> &middle) {
  std::vector<uint32_t> corners;
  for (size_t k = 0; k < 3; ++k) {
    const uint32_t a = t[k], b = t[(k + 1) % 3];
    if (level[a] <= 0) corners.push_back(a);
    const auto at = middle.find({std::min(a, b), std::max(a, b)});
    if (at != middle.end()) corners.push_back(at->second);
  }
  return corners;
}

}  // namespace

LeafletSheet part_below(const LeafletSheet &sheet, std::vector<double> level, double snap,
                        std::vector<uint8_t> &on_cut) {
  const std::vector<Edge> edges = edges_of(sheet.triangles);
  snap_to_level(edges, snap, level);
  DividedEdges divided = divide_edges(sheet, edges, level);
  LeafletSheet &made = divided.sheet;
  on_cut.assign(made.x.size(), 1);
  for (size_t i = 0; i < level.size(); ++i) on_cut[i] = level[i] == 0;
  made.triangles.clear();
  made.label.clear();
  for (size_t t = 0; t < sheet.triangles.size(); ++t) {
    const Tri &tri = sheet.triangles[t];
    if (std::none_of(tri.begin(), tri.end(), [&](uint32_t i) { return level[i] < 0; })) continue;
    std::vector<uint32_t> corner = polygon_below(tri, level, divided.middle);
    if (corner.size() == 4) {  // along its shorter diagonal
      const auto length2 = [&](size_t a, size_t b) {
        return (made.x[corner[a]] - made.x[corner[b]]).squaredNorm();
      };
      if (length2(1, 3) < length2(0, 2))
        std::rotate(corner.begin(), corner.begin() + 1, corner.end());
      made.triangles.push_back({corner[0], corner[2], corner[3]});
      made.label.push_back(sheet.label[t]);
    }
    made.triangles.push_back({corner[0], corner[1], corner[2]});
    made.label.push_back(sheet.label[t]);
  }
  return std::move(made);
}

}  // namespace mvs::core
