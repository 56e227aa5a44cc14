// Averages thickness and fibres of a fine level over the triangles of a coarse level.
#include "anatomy/coarse_tissue.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>

#include "anatomy/sheet_walk.h"

namespace mvs::core {
namespace {

// Returns the coarse triangle of the same scallop that is nearest to the centroid of a fine
// triangle; `none` if the search does not reach that scallop.
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

// Marks the coarse triangles that exist on the fine level too.
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

// Sums over the fine triangles of one coarse triangle.
struct Sum {
  double area = 0, thickness = 0;  // thickness: area times the excess over the first
  double first_thickness = 0;
  Mat3 fibre = Mat3::Zero();
};

// Returns the principal axis in the plane with this normal, oriented along `like`; `like` itself if
// the two eigenvalues are equal to rounding.
Vec3 axis_of(const Mat3 &mean, const Vec3 &normal, const Vec3 &like) {
  const Mat3 flat = Mat3::Identity() - normal * normal.transpose();
  const Eigen::SelfAdjointEigenSolver<Mat3> axes(flat * mean * flat);
  const Vec3 axis = axes.eigenvectors().col(2);
  // equal eigenvalues: every axis of the plane is a principal axis
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
