// Offsets against smoothed normals.
#include "patient/skin/mid_surface.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "geometry/intersect.h"
#include "model/compressed_rows.h"
#include "model/sides.h"
#include "patient/findings.h"
#include "patient/surface/boundary.h"
#include "patient/surface/manifold.h"
#include "patient/surface/weld.h"

namespace mvs::core {
namespace {

// Area-weighted normals, twice the mean with those of the neighbours: noise of an image turns
// single ones.
std::vector<Vec3> smooth_normals(const LeafletSheet &sheet) {
  std::vector<Vec3> normal = area_normals(sheet.x, sheet.triangles);
  for (Vec3 &n : normal) n.normalize();
  for (int round = 0; round < 2; ++round) {
    std::vector<Vec3> sum = normal;
    for (const Tri &t : sheet.triangles) {
      for (size_t k = 0; k < 3; ++k)
        sum[t[k]] += 0.5 * (normal[t[(k + 1) % 3]] + normal[t[(k + 2) % 3]]);
    }
    for (size_t i = 0; i < normal.size(); ++i) normal[i] = sum[i].normalized();
  }
  return normal;
}

// The vertices of triangles that turned over or shrank to less than a fifth, and of triangles that
// cross others and did not before.
std::vector<uint8_t> harmed(const LeafletSheet &sheet, const std::vector<Vec3> &x,
                            const std::vector<Edge> &crossings_before) {
  std::vector<uint8_t> marks(x.size(), 0);
  const auto mark = [&](uint32_t t) {
    for (const uint32_t i : sheet.triangles[t]) marks[i] = 1;
  };
  for (uint32_t t = 0; t < sheet.triangles.size(); ++t) {
    const Vec3 before = area_normal(sheet.x, sheet.triangles[t]);
    const Vec3 after = area_normal(x, sheet.triangles[t]);
    if (after.dot(before) < 0.2 * before.squaredNorm()) mark(t);
  }
  for (const Edge &pair : find_intersections(x, sheet.triangles)) {
    if (std::binary_search(crossings_before.begin(), crossings_before.end(), pair)) continue;
    mark(pair[0]);
    mark(pair[1]);
  }
  return marks;
}

// Marks the triangles that shrink to less than a half, or cross others, where each vertex moves by
// half a thickness.
std::vector<uint8_t> spoilt_by_offset(const LeafletSheet &sheet) {
  constexpr double least_area = 0.5;
  const std::vector<Vec3> normal = smooth_normals(sheet);
  std::vector<Vec3> x(sheet.x.size());
  for (size_t i = 0; i < x.size(); ++i) x[i] = sheet.x[i] - 0.5 * sheet.thickness[i] * normal[i];
  std::vector<uint8_t> marks(sheet.triangles.size(), 0);
  for (size_t t = 0; t < marks.size(); ++t) {
    const Vec3 before = area_normal(sheet.x, sheet.triangles[t]);
    marks[t] = area_normal(x, sheet.triangles[t]).dot(before) < least_area * before.squaredNorm();
  }
  for (const auto &[a, b] : find_intersections(x, sheet.triangles)) marks[a] = marks[b] = 1;
  return marks;
}

// Drops triangles with a mark at the rims, and those that are at them then, and keeps the largest
// piece. Returns whether any was dropped.
bool peel_rims(LeafletSheet &sheet, const std::vector<uint8_t> &marks) {
  std::vector<uint8_t> at_rim(sheet.x.size(), 0), kept(marks.size(), 1);
  for (const std::vector<uint32_t> &rim : boundary_loops(sheet)) {
    for (const uint32_t i : rim) at_rim[i] = 1;
  }
  bool any = false;
  for (bool more = true; more;) {
    more = false;
    for (size_t t = 0; t < marks.size(); ++t) {
      const Tri &tri = sheet.triangles[t];
      if (marks[t] == 0 || kept[t] == 0) continue;
      if (std::none_of(tri.begin(), tri.end(), [&](uint32_t i) { return at_rim[i] != 0; }))
        continue;
      kept[t] = 0;
      for (const uint32_t i : tri) at_rim[i] = 1;
      any = more = true;
    }
  }
  if (!any) return false;
  keep_triangles(sheet, kept);
  const std::vector<uint32_t> piece = pieces_of(join_sides(sheet.x, sheet.triangles).across);
  std::vector<size_t> count(piece.size() + 1, 0);
  for (const uint32_t p : piece) ++count[p];
  const auto largest = std::max_element(count.begin(), count.end()) - count.begin();
  kept.assign(piece.size(), 0);
  for (size_t t = 0; t < piece.size(); ++t) kept[t] = piece[t] == static_cast<uint32_t>(largest);
  keep_triangles(sheet, kept);
  separate_fans(sheet, join_sides(sheet.x, sheet.triangles).across);
  drop_unused(sheet);
  return true;
}

}  // namespace

void drop_round_rims(LeafletSheet &sheet) {
  constexpr int most_rounds = 4;
  const size_t rims = boundary_loops(sheet).size();
  LeafletSheet left = sheet;
  for (int round = 0; round < most_rounds; ++round) {
    if (!peel_rims(left, spoilt_by_offset(left))) break;
  }
  if (boundary_loops(left).size() >= rims) sheet = std::move(left);
}

void move_to_mid(LeafletSheet &sheet, double thickness_if_unknown, Findings &findings) {
  const size_t n = sheet.x.size();
  const bool known = !sheet.thickness.empty();
  const std::vector<Vec3> normal = smooth_normals(sheet);
  const std::vector<Edge> crossings = find_intersections(sheet.x, sheet.triangles);
  std::vector<double> share(n, 1);
  std::vector<Vec3> x(n);
  const auto offset = [&] {
    for (size_t i = 0; i < n; ++i) {
      const double half = 0.5 * (known ? sheet.thickness[i] : thickness_if_unknown);
      x[i] = sheet.x[i] - share[i] * half * normal[i];
    }
  };
  offset();
  constexpr int most_rounds = 8;  // halving leaves 0.4 % of the way
  for (int round = 0; round <= most_rounds; ++round) {
    const std::vector<uint8_t> marks = harmed(sheet, x, crossings);
    if (std::find(marks.begin(), marks.end(), 1) == marks.end()) break;
    for (size_t i = 0; i < n; ++i) {
      if (marks[i] != 0) share[i] = round < most_rounds ? 0.5 * share[i] : 0;
    }
    offset();
  }
  double way = 0;
  size_t limited = 0;
  for (size_t i = 0; i < n; ++i) {
    way += (x[i] - sheet.x[i]).norm() / static_cast<double>(n);
    limited += share[i] < 1;
  }
  sheet.x = x;
  add_measured(findings, "mid_surface",
               format("the surface was moved by %.2f mm in the mean away from the atrium, to the "
                      "middle of the tissue; by less at %zu vertices in folds",
                      way * 1e3, limited),
               {way}, "m");
  if (!known) {
    findings.back().source = FindingSource::assumed;
    findings.back().confidence = 0.5;
  }
}

}  // namespace mvs::core
