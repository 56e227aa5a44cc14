// Greedy flips. Each is tested against the triangles near it, and so are the pairs that it changes:
// a scan with noise has thousands of them.
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

// The surface while it is flipped.
struct FlippedSheet {
  LeafletSheet &sheet;
  TriangleGrid grid;
  std::vector<std::vector<uint32_t>> stars;          // the triangles at each vertex
  std::vector<std::array<uint8_t, 3>> is_refused{};  // sides whose flip is known to remove nothing
};

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

// Puts two triangles in the place of those of a pair. Sides that were refused near them are to be
// tried again.
void replace(FlippedSheet &flipped, const Edge &pair, const std::array<Tri, 2> &shape) {
  LeafletSheet &sheet = flipped.sheet;
  Aabb changed;
  for (size_t l = 0; l < 2; ++l) {
    Tri &tri = sheet.triangles[pair[l]];
    changed.add(aabb_of(sheet.x, tri));
    for (const uint32_t v : tri) std::erase(flipped.stars[v], pair[l]);
    tri = shape[l];
    for (const uint32_t v : tri) flipped.stars[v].push_back(pair[l]);
    flipped.grid.remove(pair[l]);
    flipped.grid.insert(pair[l], aabb_of(sheet.x, tri));
  }
  // a flip depends on what is near the triangle and its neighbour
  flipped.grid.any_near(changed, [&](uint32_t near, const Aabb &) {
    for (const uint32_t v : sheet.triangles[near]) {
      for (const uint32_t t : flipped.stars[v]) flipped.is_refused[t] = {};
    }
    return false;
  });
}

// The pairs of two triangles anew, all sorted as by find_intersections().
void renew_pairs(const FlippedSheet &flipped, const Edge &changed, std::vector<Edge> &pairs) {
  const LeafletSheet &sheet = flipped.sheet;
  const auto is_changed = [&](uint32_t t) { return t == changed[0] || t == changed[1]; };
  std::erase_if(pairs,
                [&](const Edge &pair) { return is_changed(pair[0]) || is_changed(pair[1]); });
  for (const uint32_t t : changed) {
    const Tri &mine = sheet.triangles[t];
    flipped.grid.any_near(aabb_of(sheet.x, mine), [&](uint32_t other, const Aabb &) {
      const bool is_first = !is_changed(other) || t < other;  // a pair of both once
      if (other != t && is_first && mesh_triangles_cross(sheet.x, mine, sheet.triangles[other])) {
        pairs.push_back({std::min(t, other), std::max(t, other)});
      }
      return false;
    });
  }
  std::sort(pairs.begin(), pairs.end());
}

// Flips side k of triangle t if that removes a crossing.
bool flip_side(FlippedSheet &flipped, uint32_t t, size_t k, std::vector<Edge> &pairs) {
  LeafletSheet &sheet = flipped.sheet;
  const std::vector<std::vector<uint32_t>> &stars = flipped.stars;
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
  if (crossings_of(sheet, flipped.grid, pair, after) >=
      crossings_of(sheet, flipped.grid, pair, before)) {
    return false;
  }
  replace(flipped, pair, after);
  renew_pairs(flipped, pair, pairs);
  return true;
}

}  // namespace

std::vector<Edge> flip_crossings(LeafletSheet &sheet, std::vector<Edge> pairs) {
  const double side = std::sqrt(surface_area(sheet.x, sheet.triangles) /
                                static_cast<double>(sheet.triangles.size()));
  FlippedSheet flipped{sheet, TriangleGrid(sheet.x, sheet.triangles, 2 * side),
                       std::vector<std::vector<uint32_t>>(sheet.x.size())};
  flipped.is_refused.resize(sheet.triangles.size());
  for (uint32_t t = 0; t < sheet.triangles.size(); ++t) {
    for (const uint32_t v : sheet.triangles[t]) flipped.stars[v].push_back(t);
  }
  const auto flip_one = [&] {
    for (const Edge &pair : pairs) {
      for (const uint32_t t : pair) {
        for (size_t k = 0; k < 3; ++k) {
          uint8_t &is_refused = flipped.is_refused[t][k];
          if (is_refused) continue;
          if (flip_side(flipped, t, k, pairs)) return true;
          is_refused = 1;
        }
      }
    }
    return false;
  };
  // each flip lowers the number of pairs, so this ends
  while (flip_one()) {
  }
  return pairs;
}

}  // namespace mvs::core
