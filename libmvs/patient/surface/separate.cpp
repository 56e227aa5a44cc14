// Copies of vertices where parts of a surface touch.
#include <algorithm>

#include "model/compressed_rows.h"
#include "model/sides.h"
#include "patient/surface/manifold.h"

namespace mvs::core {
namespace {

// Puts a new vertex into the middle of a side of a triangle and of the side across it.
void split_pair(LeafletSheet &sheet, const std::array<uint32_t, 2> &pair, const Edge &edge) {
  const uint32_t middle = static_cast<uint32_t>(sheet.x.size());
  sheet.x.push_back(0.5 * (sheet.x[edge[0]] + sheet.x[edge[1]]));
  if (!sheet.thickness.empty()) {
    sheet.thickness.push_back(0.5 * (sheet.thickness[edge[0]] + sheet.thickness[edge[1]]));
  }
  for (const uint32_t t : pair) {
    Tri half = sheet.triangles[t];
    std::replace(half.begin(), half.end(), edge[0], middle);
    std::replace(sheet.triangles[t].begin(), sheet.triangles[t].end(), edge[1], middle);
    sheet.triangles.push_back(half);
    sheet.label.push_back(LeafletLabel(sheet.label[t]));
  }
}

}  // namespace

size_t separate_fans(LeafletSheet &sheet, const std::vector<uint32_t> &across) {
  // corners 3 t + k that are one vertex: those at the ends of joined sides
  const std::vector<Tri> before = sheet.triangles;
  const Rows stars = rows_of(sheet.x.size(), before);
  std::vector<uint8_t> seen(across.size(), 0);
  const auto corner_in = [&](uint32_t t, uint32_t vertex) {
    const Tri &tri = before[t];
    return 3 * t + (tri[0] == vertex ? 0u : (tri[1] == vertex ? 1u : 2u));
  };
  size_t copies = 0;
  const uint32_t count = static_cast<uint32_t>(sheet.x.size());
  std::vector<uint32_t> open;
  for (uint32_t vertex = 0; vertex < count; ++vertex) {
    bool first = true;
    for (const uint32_t t : stars[vertex]) {
      if (seen[corner_in(t, vertex)] != 0) continue;
      const uint32_t name = first ? vertex : static_cast<uint32_t>(sheet.x.size());
      if (!first) {
        sheet.x.push_back(Vec3(sheet.x[vertex]));
        if (!sheet.thickness.empty()) sheet.thickness.push_back(double(sheet.thickness[vertex]));
        ++copies;
      }
      first = false;
      seen[corner_in(t, vertex)] = 1;
      open.assign(1, t);
      while (!open.empty()) {
        const uint32_t here = open.back();
        open.pop_back();
        const uint32_t corner = corner_in(here, vertex), k = corner % 3;
        sheet.triangles[here][k] = name;
        for (const uint32_t side : {3 * here + k, 3 * here + (k + 2) % 3}) {
          if (across[side] == none) continue;
          const uint32_t next = across[side] / 3;
          if (seen[corner_in(next, vertex)] != 0) continue;
          seen[corner_in(next, vertex)] = 1;
          open.push_back(next);
        }
      }
    }
  }
  return copies;
}

size_t split_shared_edges(LeafletSheet &sheet) {
  // a triangle with three such edges takes one in each round
  constexpr int most_rounds = 10;
  size_t made = 0;
  for (int round = 0; round < most_rounds; ++round) {
    const SurfaceJoin join = join_sides(sheet.x, sheet.triangles);
    if (join.opened == 0) break;
    const std::vector<Side> sides = sorted_sides(sheet.triangles);
    std::vector<uint8_t> claimed(sheet.triangles.size(), 0);
    for_each_edge(sides, [&](size_t first, size_t last) {
      if (last - first <= 2) return;
      for (size_t s = first; s < last; ++s) {
        const uint32_t here = 3 * sides[s].triangle + sides[s].k, there = join.across[here];
        if (there == none || there < here) continue;
        const std::array<uint32_t, 2> pair = {here / 3, there / 3};
        if (claimed[pair[0]] != 0 || claimed[pair[1]] != 0) continue;
        claimed[pair[0]] = claimed[pair[1]] = 1;
        split_pair(sheet, pair, sides[s].edge);
        ++made;
      }
    });
  }
  return made;
}

}  // namespace mvs::core
