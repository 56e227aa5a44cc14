// Sides without a neighbour, chained to loops.
#include "patient/surface/boundary.h"

#include <algorithm>
#include <utility>

#include "base/error.h"
#include "base/math.h"
#include "measure/annulus/landmarks.h"
#include "model/sides.h"

namespace mvs::core {
namespace {

// The sum of the angles between chords, in turns: 1 for a plane convex curve, more for others. The
// chords, 4 to 6 mm long, skip the noise of single vertices.
double turning_of(const Loop &curve) {
  constexpr int steps = 24;
  constexpr double full_turn = 6.283185307179586;
  const double step = curve.length() / steps;
  double sum = 0;
  for (int k = 0; k < steps; ++k) {
    const Vec3 a = curve.at(k * step), b = curve.at((k + 1) * step), c = curve.at((k + 2) * step);
    const Vec3 before = b - a, after = c - b;
    sum += math::atan2(before.cross(after).norm(), before.dot(after));
  }
  return sum / full_turn;
}

// The length of chords of 2 to 3 mm, which skip the steps of voxels.
double chord_length_of(const Loop &curve) {
  constexpr int steps = 48;
  const double step = curve.length() / steps;
  double sum = 0;
  for (int k = 0; k < steps; ++k) sum += (curve.at((k + 1) * step) - curve.at(k * step)).norm();
  return sum;
}

}  // namespace

std::vector<std::vector<uint32_t>> boundary_loops(const LeafletSheet &sheet) {
  std::vector<uint32_t> next(sheet.x.size(), none);
  const std::vector<Side> sides = sorted_sides(sheet.triangles);
  for_each_edge(sides, [&](size_t first, size_t last) {
    if (last - first != 1) return;
    uint32_t &to = next[side_from(sheet.triangles, sides[first])];
    MVS_MUST(to == none, MVS_E_OP, "triangles",
             "two boundaries leave one vertex: the triangles are not wound alike, or touch in a "
             "single point; clean the surface first");
    to = side_to(sheet.triangles, sides[first]);
  });
  std::vector<std::vector<uint32_t>> loops;
  for (uint32_t start = 0; start < next.size(); ++start) {
    if (next[start] == none) continue;
    std::vector<uint32_t> loop;
    uint32_t i = start;
    while (i != none && next[i] != none) {
      loop.push_back(i);
      const uint32_t to = next[i];
      next[i] = none;
      i = to;
    }
    MVS_MUST(i == start, MVS_E_OP, "triangles",
             "a boundary does not close: the triangles are not wound alike; clean the surface "
             "first");
    loops.push_back(std::move(loop));
  }
  return loops;
}

LoopShape shape_of(const LeafletSheet &sheet, const std::vector<uint32_t> &loop) {
  const Loop curve(loop, sheet.x);
  LoopShape shape;
  shape.length = curve.length();
  shape.centre = centroid(curve);
  for (size_t k = 0; k < loop.size(); ++k) {
    const Vec3 a = curve.point(k) - shape.centre, b = curve.point(k + 1) - shape.centre;
    shape.area += 0.5 * a.cross(b);
  }
  shape.chord_length = chord_length_of(curve);
  shape.turning = turning_of(curve);
  return shape;
}

std::vector<RimLoop> sorted_rims(const LeafletSheet &sheet) {
  std::vector<RimLoop> rims;
  for (std::vector<uint32_t> &loop : boundary_loops(sheet)) {
    const LoopShape shape = shape_of(sheet, loop);
    rims.push_back({std::move(loop), shape});
  }
  std::stable_sort(rims.begin(), rims.end(), [](const RimLoop &a, const RimLoop &b) {
    return a.shape.length > b.shape.length;
  });
  return rims;
}

}  // namespace mvs::core
