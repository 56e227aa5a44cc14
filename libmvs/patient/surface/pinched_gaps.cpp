// Vertices of a rim at one place, and the gap between them.
#include "patient/surface/pinched_gaps.h"

#include <algorithm>

#include "base/error.h"
#include "model/sides.h"
#include "patient/surface/boundary.h"
#include "patient/surface/fill_hole.h"
#include "patient/surface/holes.h"
#include "patient/surface/weld.h"

namespace mvs::core {
namespace {

// Whether the gap is one and not a second orifice or a cleft that closes at its mouth is a guess.
constexpr double confidence = 0.5;

// A stretch of a boundary that begins and ends at one place: `ring` begins with the vertex that
// stays; the vertex at its end is `other`.
struct Gap {
  std::vector<uint32_t> ring;
  uint32_t other = none;
  double length = 0;  // m
};

// A boundary has tissue on its left, seen from the tip of the normal: around a gap it turns
// clockwise.
bool surrounds_gap(const std::vector<Vec3> &normal, const Gap &gap, const LoopShape &shape) {
  Vec3 up = Vec3::Zero();
  for (size_t k = 1; k < gap.ring.size(); ++k) up += normal[gap.ring[k]];
  return shape.area.dot(up) < 0;
}

// Pairs of places of a loop with the same point, which follow each other in the order of points.
std::vector<std::array<size_t, 2>> coincident_places(const LeafletSheet &sheet,
                                                     const std::vector<uint32_t> &loop) {
  std::vector<std::pair<std::array<double, 3>, size_t>> sorted;
  for (size_t k = 0; k < loop.size(); ++k) {
    const Vec3 &p = sheet.x[loop[k]];
    sorted.push_back({{p.x(), p.y(), p.z()}, k});
  }
  std::sort(sorted.begin(), sorted.end());
  std::vector<std::array<size_t, 2>> places;
  for (size_t k = 1; k < sorted.size(); ++k) {
    if (sorted[k].first == sorted[k - 1].first) {
      places.push_back({sorted[k - 1].second, sorted[k].second});
    }
  }
  return places;
}

// The shortest gap; its ring is empty if no gap exists.
Gap shortest_gap(const LeafletSheet &sheet) {
  const std::vector<std::vector<uint32_t>> loops = boundary_loops(sheet);
  double longest = 0;
  for (const auto &loop : loops) longest = std::max(longest, shape_of(sheet, loop).length);
  std::vector<Vec3> normal;
  Gap best;
  best.length = hole_share * longest;
  for (const auto &loop : loops) {
    for (const auto &[first, second] : coincident_places(sheet, loop)) {
      if (normal.empty()) normal = area_normals(sheet.x, sheet.triangles);
      const size_t n = loop.size();
      for (const auto &[from, to] : {std::pair{first, second}, std::pair{second, first + n}}) {
        Gap gap;
        for (size_t k = from; k < to; ++k) gap.ring.push_back(loop[k % n]);
        gap.other = loop[to % n];
        if (gap.ring.size() < 3) continue;
        const LoopShape shape = shape_of(sheet, gap.ring);
        gap.length = shape.length;
        if (gap.length < best.length && surrounds_gap(normal, gap, shape)) best = std::move(gap);
      }
    }
  }
  return best;
}

}  // namespace

void fill_pinched_gaps(LeafletSheet &sheet, Findings &findings) {
  std::vector<double> lengths;
  size_t triangles = 0;
  for (Gap gap = shortest_gap(sheet); !gap.ring.empty(); gap = shortest_gap(sheet)) {
    for (Tri &t : sheet.triangles) std::replace(t.begin(), t.end(), gap.other, gap.ring[0]);
    triangles += fill_hole(sheet, gap.ring);
    drop_unused(sheet);
    lengths.push_back(gap.length);
  }
  if (lengths.empty()) return;
  findings.push_back(
      {"pinched_gaps", FindingSource::guessed, confidence,
       format(
           "%zu gaps, the longest %.1f mm around, open to a rim in a single point, where tissue "
           "touches itself, and were filled with %zu triangles: if one is a cleft or an orifice, "
           "part the tissue at that point",
           lengths.size(), *std::max_element(lengths.begin(), lengths.end()) * 1e3, triangles),
       lengths, "m"});
}

}  // namespace mvs::core
