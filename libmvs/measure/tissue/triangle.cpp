// Cauchy stress from the law of the membrane, or from the springs along the sides.
#include "measure/tissue/triangle.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

namespace mvs::core {
namespace {

using Vec2 = Eigen::Vector2d;

// Virial stress of the springs of a triangle: the sum of force x length n n^T over its present
// volume. The share of a side in the force is sigma t A0 / L0 (Van Gelder 1998), and the volume A0
// t is constant as tissue is incompressible, so that t and A0 cancel.
Mat2 spring_stress(const Bilinear &law, const Sides &rest, const Sides &now) {
  Mat2 stress = Mat2::Zero();
  for (int k = 0; k < 3; ++k) {
    const double length = now.col(k).norm();
    const double stretch = length / rest.col(k).norm();
    const Vec2 direction = now.col(k) / length;
    stress += law.stress(stretch - 1) * stretch * direction * direction.transpose();
  }
  return stress;
}

// Cauchy stress of a membrane, 2 F (dW/dC) F^T; the determinant of the three-dimensional F is 1.
Mat2 membrane_stress(const LeafletLaw &law, const Constants &constants, const Mat2 &f) {
  const Mat2 c = f.transpose() * f;
  const InPlaneStrain strain{c(0, 0), c(1, 1), c(0, 1)};
  const double i1 = strain.a + strain.b + 1 / strain.det();
  const Vec3 slope = in_plane_stress(law.response(constants, i1, strain.a), strain).first;
  Mat2 s;
  s << 2 * slope[0], slope[2], slope[2], 2 * slope[1];
  return f * s * f.transpose();
}

}  // namespace

Sides sides_in_plane(const std::vector<Vec3> &x, const Tri &triangle) {
  const Vec3 first = x[triangle[1]] - x[triangle[0]], last = x[triangle[2]] - x[triangle[0]];
  const double length = first.norm();
  const Vec2 u(length, 0);
  const Vec2 v(first.dot(last) / length, first.cross(last).norm() / length);
  Sides sides;
  sides << u, v - u, -v;
  return sides;
}

Mat2 deformation_gradient(const Valve &valve, size_t t, const Sides &now) {
  Mat2 sides;
  sides << now.col(0), -now.col(2);
  return sides * rest_inverse(valve, t);
}

Mat2 cauchy_stress(const Valve &valve, size_t t, const Sides &rest, const Sides &now) {
  const Leaflet &leaflet = valve.leaflets[valve.triangle_leaflet[t]];
  const LeafletLaw &law = *find_leaflet_law(leaflet.law);
  if (!law.response) return spring_stress(Bilinear(leaflet.constants), rest, now);
  return membrane_stress(law, leaflet.constants, deformation_gradient(valve, t, now));
}

}  // namespace mvs::core
