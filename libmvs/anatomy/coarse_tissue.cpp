#include "anatomy/coarse_tissue.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>

#include "anatomy/sheet_walk.h"

namespace mvs::core {
namespace {

// The coarse triangle of the same scallop on which the middle of a fine triangle lies; `none` where
// the walk finds no way into that scallop.
uint32_t triangle_under(const Model &fine, uint32_t t, const LevelMap &map, const SheetWalk &walk) {
  const auto &[a, b, c] = fine.valve.triangles[t];
  const Vec3 middle = (fine.valve.rest[a] + fine.valve.rest[b] + fine.valve.rest[c]) / 3;
  for (const uint32_t corner : {a, b, c}) {
    for (const uint32_t start : map.place[corner].nodes) {
      const uint32_t found = walk.nearest(start, middle, fine.valve.triangle_scallop[t]);
      if (found != none) return found;
    }
  }
  return none;
}

Tri sorted(Tri triangle) {
  std::sort(triangle.begin(), triangle.end());
  return triangle;
}

// The coarse triangles that are triangles of the fine level too.
std::vector<uint8_t> unchanged(const Model &fine, const LevelMap &map, const Valve &coarse) {
  std::vector<Tri> all;
  for (const Tri &triangle : fine.valve.triangles) all.push_back(sorted(triangle));
  std::sort(all.begin(), all.end());
  std::vector<uint8_t> same;
  for (Tri triangle : coarse.triangles.get()) {
    for (uint32_t &node : triangle) node = map.fine_of_coarse[node];
    same.push_back(std::binary_search(all.begin(), all.end(), sorted(triangle)));
  }
  return same;
}

// What the fine triangles of one coarse triangle add up to.
struct Sum {
  double area = 0, thickness = 0;  // thickness over the first one's, times area
  double first_thickness = 0;
  Mat3 fibre = Mat3::Zero();
};

// The principal axis in the plane with this normal, on the side of `like`; `like` itself where the
// mean has no axis there.
Vec3 axis_of(const Mat3 &mean, const Vec3 &normal, const Vec3 &like) {
  const Mat3 flat = Mat3::Identity() - normal * normal.transpose();
  const Eigen::SelfAdjointEigenSolver<Mat3> axes(flat * mean * flat);
  const Vec3 axis = axes.eigenvectors().col(2);
  // both axes of the plane are as good where they differ by less than rounding
  if (axes.eigenvalues()[2] - axes.eigenvalues()[1] <= 1e-9 * mean.trace()) return like;
  return axis.dot(like) < 0 ? Vec3(-axis) : axis;
}

}  // namespace

void average_tissue(const Model &fine, const LevelMap &map, const Model &coarse, Valve &valve) {
  const SheetWalk walk(coarse);
  std::vector<Sum> sums(coarse.valve.triangles.size());
  for (uint32_t t = 0; t < fine.valve.triangles.size(); ++t) {
    const uint32_t under = triangle_under(fine, t, map, walk);
    if (under == none) continue;
    Sum &sum = sums[under];
    const double thickness = fine.valve.triangle_thickness[t], area = fine.rest_area[t];
    const Vec3 &fibre = fine.valve.triangle_fibre[t];
    if (sum.area == 0) sum.first_thickness = thickness;
    sum.area += area;
    sum.thickness += area * (thickness - sum.first_thickness);
    sum.fibre += area * fibre * fibre.transpose();
  }
  const std::vector<uint8_t> same = unchanged(fine, map, coarse.valve);
  const std::vector<Vec3> &x = coarse.valve.rest;
  for (uint32_t t = 0; t < sums.size(); ++t) {
    if (same[t] || sums[t].area == 0) continue;
    const auto &[a, b, c] = coarse.valve.triangles[t];
    const Vec3 normal = (x[b] - x[a]).cross(x[c] - x[a]).normalized();
    valve.triangle_thickness[t] = sums[t].first_thickness + sums[t].thickness / sums[t].area;
    valve.triangle_fibre[t] = axis_of(sums[t].fibre, normal, coarse.valve.triangle_fibre[t]);
  }
}

}  // namespace mvs::core
