// Flips and drops of flat triangles.
#include <algorithm>
#include <cmath>

#include "model/sides.h"
#include "patient/surface/manifold.h"
#include "patient/surface/weld.h"

namespace mvs::core {
namespace {

// A triangle's height over its longest side.
struct FlatTriangle {
  uint32_t side = none;  // the longest
  double flatness = 1;   // height over it
};

FlatTriangle flatness_of(const std::vector<Vec3> &x, const std::vector<Tri> &triangles,
                         uint32_t t) {
  FlatTriangle flat;
  double longest = 0;
  for (uint32_t side = 3 * t; side < 3 * t + 3; ++side) {
    const double length = (x[side_end(triangles, side)] - x[side_start(triangles, side)]).norm();
    if (length > longest) {
      longest = length;
      flat.side = side;
    }
  }
  if (longest > 0) flat.flatness = 2 * triangle_area(x, triangles[t]) / (longest * longest);
  return flat;
}

bool has_edge(const std::vector<Tri> &triangles, uint32_t a, uint32_t b) {
  for (const Tri &t : triangles) {
    const bool has_a = t[0] == a || t[1] == a || t[2] == a;
    const bool has_b = t[0] == b || t[1] == b || t[2] == b;
    if (has_a && has_b) return true;
  }
  return false;
}

// Whether a vertex is on the boundary.
bool at_boundary(const std::vector<Tri> &triangles, const std::vector<uint32_t> &across,
                 uint32_t vertex) {
  for (uint32_t side = 0; side < across.size(); ++side) {
    if (across[side] != none) continue;
    if (side_start(triangles, side) == vertex || side_end(triangles, side) == vertex) return true;
  }
  return false;
}

// Flips the longest side of a flat triangle, or marks it as dropped if that side is on the boundary
// and the corner opposite is not; returns whether that was possible.
bool remove_one(std::vector<Tri> &triangles, const std::vector<uint32_t> &across, uint32_t side,
                std::vector<uint8_t> &kept) {
  const uint32_t t = side / 3;
  const uint32_t a = side_start(triangles, side), b = side_end(triangles, side);
  const uint32_t c = opposite_corner(triangles[t], {a, b});
  if (across[side] == none) {
    if (at_boundary(triangles, across, c)) return false;
    kept[t] = 0;
    return true;
  }
  const uint32_t u = across[side] / 3;
  const uint32_t d = opposite_corner(triangles[u], {a, b});
  if (d == c || has_edge(triangles, c, d)) return false;
  triangles[t] = {a, d, c};
  triangles[u] = {d, b, c};
  return true;
}

// Marks a triangle and those across its sides.
void mark_around(const std::vector<uint32_t> &across, uint32_t t, std::vector<uint8_t> &marks) {
  marks[t] = 1;
  for (uint32_t side = 3 * t; side < 3 * t + 3; ++side) {
    if (across[side] != none) marks[across[side] / 3] = 1;
  }
}

}  // namespace

size_t remove_flat(LeafletSheet &sheet) {
  constexpr double flattest = 1e-3;
  // a flip can leave a neighbour flat, in rows of points on one line one after another
  constexpr int most_rounds = 20;
  size_t removed = 0;
  for (int round = 0; round < most_rounds; ++round) {
    const std::vector<uint32_t> across = join_sides(sheet.x, sheet.triangles).across;
    std::vector<uint8_t> kept(sheet.triangles.size(), 1);
    std::vector<uint8_t> changed(sheet.triangles.size(), 0);  // or beside one that was
    size_t now = 0;
    for (uint32_t t = 0; t < sheet.triangles.size(); ++t) {
      const FlatTriangle flat = flatness_of(sheet.x, sheet.triangles, t);
      if (changed[t] != 0 || flat.flatness >= flattest) continue;
      const uint32_t other = across[flat.side];
      if (other != none && changed[other / 3] != 0) continue;
      if (!remove_one(sheet.triangles, across, flat.side, kept)) continue;
      mark_around(across, t, changed);
      if (other != none) mark_around(across, other / 3, changed);
      ++now;
    }
    if (now == 0) break;
    removed += now;
    keep_triangles(sheet, kept);
  }
  return removed;
}

}  // namespace mvs::core
