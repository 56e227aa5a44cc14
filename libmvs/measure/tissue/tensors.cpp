// Tensors of each triangle from its deformation gradient F = R U, and their means at the nodes.
#include "measure/tissue/tensors.h"

#include <cmath>

#include "measure/tissue/triangle.h"

namespace mvs::core {
namespace {

using Vec2 = Eigen::Vector2d;

Vec3 components(const Mat2 &m) {
  return {m(0, 0), m(1, 1), 0.5 * (m(0, 1) + m(1, 0))};
}

// The rotation of the polar decomposition of a 2 x 2 matrix with a positive determinant, in closed
// form (Shoemake, Duff, GI 1992).
Mat2 rotation_of(const Mat2 &f) {
  Mat2 r;
  r << f(0, 0) + f(1, 1), f(0, 1) - f(1, 0), f(1, 0) - f(0, 1), f(0, 0) + f(1, 1);
  return r / std::sqrt(r(0, 0) * r(0, 0) + r(1, 0) * r(1, 0));
}

// The eigenvector of the larger eigenvalue of a symmetric matrix: the longer column of the matrix
// minus its smaller eigenvalue.
Vec2 first_eigenvector(const Mat2 &c) {
  const double half = 0.5 * (c(0, 0) - c(1, 1));
  const double radius = std::sqrt(half * half + c(0, 1) * c(0, 1));
  const Vec2 along(half + radius, c(0, 1)), across(c(0, 1), radius - half);
  const Vec2 longer = along.squaredNorm() >= across.squaredNorm() ? along : across;
  const double length = longer.norm();
  return length > 0 ? Vec2(longer / length) : Vec2(1, 0);  // equal stretches: the fibre
}

// A direction in the basis of the present sides as a unit vector in space.
Vec3 in_space(const std::vector<Vec3> &x, const Tri &triangle, const Vec2 &direction) {
  const Vec3 u = (x[triangle[1]] - x[triangle[0]]).normalized();
  const Vec3 w = x[triangle[2]] - x[triangle[0]];
  const Vec3 v = (w - u.dot(w) * u).normalized();
  return (direction[0] * u + direction[1] * v).normalized();
}

std::vector<Vec3> means_at_nodes(const Model &model, const std::vector<Vec3> &rows) {
  std::vector<Vec3> mean(model.node_count(), Vec3::Zero());
  std::vector<double> area(model.node_count(), 0.0);
  for (size_t t = 0; t < rows.size(); ++t) {
    for (const uint32_t node : model.valve.triangles[t]) {
      mean[node] += model.rest_area[t] * rows[t];
      area[node] += model.rest_area[t];
    }
  }
  for (size_t n = 0; n < mean.size(); ++n) {
    if (area[n] > 0) mean[n] /= area[n];
  }
  return mean;
}

}  // namespace

Tensors measure_tensors(const Model &model, const std::vector<Vec3> &x) {
  const Valve &valve = model.valve;
  Tensors found;
  for (size_t t = 0; t < valve.triangles.size(); ++t) {
    const Sides rest = sides_in_plane(valve.rest, valve.triangles[t]);
    const Sides now = sides_in_plane(x, valve.triangles[t]);
    const Mat2 f = deformation_gradient(valve, t, now), c = f.transpose() * f;
    const Mat2 r = rotation_of(f);
    found.strain.push_back(0.5 * (components(c) - Vec3(1, 1, 0)));
    found.stress.push_back(components(r.transpose() * cauchy_stress(valve, t, rest, now) * r));
    found.direction.push_back(in_space(x, valve.triangles[t], f * first_eigenvector(c)));
  }
  found.node_strain = means_at_nodes(model, found.strain);
  found.node_stress = means_at_nodes(model, found.stress);
  return found;
}

}  // namespace mvs::core
