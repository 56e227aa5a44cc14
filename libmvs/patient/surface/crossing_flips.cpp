// Greedy flips, each tested against the triangles near it.
#include "patient/surface/crossing_flips.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "geometry/intersect.h"
#include "model/compressed_rows.h"
#include "model/sides.h"
#include "patient/mesh/sheet_edit.h"
#include "patient/mesh/triangle_grid.h"

namespace mvs::core {
namespace {

// Number of pairs of one or both of two triangles, given as they would be, with all others.
size_t crossings_of(const LeafletSheet &sheet, const TriangleGrid &grid, const Edge &id,
                    const std::array<Tri, 2> &shape) {
  size_t count = triangles_cross(sheet.x, shape[0], shape[1]) ? 1 : 0;
  for (const Tri &mine : shape) {
    grid.any_near(aabb_of(sheet.x, mine), [&](uint32_t t, const Aabb &) {
      const bool other = t != id[0] && t != id[1];
      if (other && mesh_triangles_cross(sheet.x, mine, sheet.triangles[t])) ++count;
      return false;
    });
  }
  return count;
}

Vec3 area_vector(const LeafletSheet &sheet, const Tri &t) {
  return (sheet.x[t[1]] - sheet.x[t[0]]).cross(sheet.x[t[2]] - sheet.x[t[0]]);
}

double worst_of(const LeafletSheet &sheet, const std::array<Tri, 2> &shape) {
  const auto cosine = [&](const Tri &t) {
    return worst_cosine(sheet.x[t[0]], sheet.x[t[1]], sheet.x[t[2]]);
  };
  return std::max(cosine(shape[0]), cosine(shape[1]));
}

// Flips side k of triangle t if that removes a crossing.
bool flip_side(LeafletSheet &sheet, TriangleGrid &grid, const Rows &stars, uint32_t t, size_t k) {
  const Tri tri = sheet.triangles[t];
  const uint32_t a = tri[k], b = tri[(k + 1) % 3], c = tri[(k + 2) % 3];
  uint32_t u = none, d = none;
  for (const uint32_t other : stars[a]) {
    for (size_t l = 0; l < 3; ++l) {
      const Tri &o = sheet.triangles[other];
      if (o[l] != b || o[(l + 1) % 3] != a) continue;
      u = other;
      d = o[(l + 2) % 3];
    }
  }
  if (u == none) return false;
  for (const uint32_t other : stars[c]) {
    const Tri &o = sheet.triangles[other];
    if (std::find(o.begin(), o.end(), d) != o.end()) return false;
  }
  const std::array<Tri, 2> before = {tri, sheet.triangles[u]};
  const std::array<Tri, 2> after = {Tri{a, d, c}, Tri{d, b, c}};
  const Vec3 n0 = area_vector(sheet, after[0]), n1 = area_vector(sheet, after[1]);
  const Vec3 whole = area_vector(sheet, before[0]) + area_vector(sheet, before[1]);
  if (n0.dot(n1) <= 0 || n0.dot(whole) <= 0 || n1.dot(whole) <= 0) return false;
  if (worst_of(sheet, after) > worst_of(sheet, before)) return false;
  const Edge pair = {t, u};
  if (crossings_of(sheet, grid, pair, after) >= crossings_of(sheet, grid, pair, before))
    return false;
  for (size_t l = 0; l < 2; ++l) {
    sheet.triangles[pair[l]] = after[l];
    grid.remove(pair[l]);
    grid.insert(pair[l], aabb_of(sheet.x, after[l]));
  }
  return true;
}

}  // namespace

std::vector<Edge> flip_crossings(LeafletSheet &sheet, std::vector<Edge> pairs) {
  const double side = std::sqrt(surface_area(sheet.x, sheet.triangles) /
                                static_cast<double>(sheet.triangles.size()));
  TriangleGrid grid(sheet.x, sheet.triangles, 2 * side);
  const auto flip_one = [&] {
    const Rows stars = rows_of(sheet.x.size(), sheet.triangles);
    for (const Edge &pair : pairs) {
      for (const uint32_t t : pair) {
        for (size_t k = 0; k < 3; ++k) {
          if (flip_side(sheet, grid, stars, t, k)) return true;
        }
      }
    }
    return false;
  };
  // each flip lowers the number of pairs, so this ends
  while (!pairs.empty() && flip_one()) pairs = find_intersections(sheet.x, sheet.triangles);
  return pairs;
}

}  // namespace mvs::core
