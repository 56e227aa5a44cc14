// Principal stretches from the deformation gradient of each triangle; principal stresses from the
// law of its membrane, or from the springs along its sides.
#include "measure/tissue/strain.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "base/math.h"
#include "model/membrane.h"

namespace mvs::core {
namespace {

using Vec2 = Eigen::Vector2d;
using Sides = Eigen::Matrix<double, 2, 3>;

// The sides of a triangle (corner k to k + 1) in a basis of its own plane, first along side 0.
Sides sides_in_plane(const std::vector<Vec3> &x, const Tri &triangle) {
  const Vec3 first = x[triangle[1]] - x[triangle[0]], last = x[triangle[2]] - x[triangle[0]];
  const double length = first.norm();
  const Vec2 u(length, 0);
  const Vec2 v(first.dot(last) / length, first.cross(last).norm() / length);
  Sides sides;
  sides << u, v - u, -v;
  return sides;
}

// Eigenvalues of a symmetric matrix, larger first.
std::array<double, 2> principal(const Mat2 &m) {
  const double mean = 0.5 * (m(0, 0) + m(1, 1));
  const double radius = math::hypot(0.5 * (m(0, 0) - m(1, 1)), m(0, 1));
  return {mean + radius, mean - radius};
}

std::array<double, 2> principal_stretches(const Sides &rest, const Sides &now) {
  Mat2 from, to;
  from << rest.col(0), rest.col(2);
  to << now.col(0), now.col(2);
  const Mat2 f = to * from.inverse();
  const std::array<double, 2> squares = principal(f.transpose() * f);
  return {std::sqrt(squares[0]), std::sqrt(std::max(squares[1], 0.0))};
}

// Virial stress of the springs of a triangle: the sum of force x length n n^T over its present
// volume. The share of a side in the force is sigma t A0 / L0 (Van Gelder 1998), and the volume A0
// t is constant as tissue is incompressible, so that t and A0 cancel.
std::array<double, 2> principal_stresses(const Bilinear &law, const Sides &rest, const Sides &now) {
  Mat2 stress = Mat2::Zero();
  for (int k = 0; k < 3; ++k) {
    const double length = now.col(k).norm();
    const double stretch = length / rest.col(k).norm();
    const Vec2 direction = now.col(k) / length;
    stress += law.stress(stretch - 1) * stretch * direction * direction.transpose();
  }
  return principal(stress);
}

// Cauchy stress of a membrane, 2 F (dW/dC) F^T; the determinant of the three-dimensional F is 1.
std::array<double, 2> principal_stresses(const LeafletLaw &law, const Constants &constants,
                                         const Mat2 &inverse, const Sides &now) {
  Mat2 sides;
  sides << now.col(0), -now.col(2);
  const Mat2 f = sides * inverse, c = f.transpose() * f;
  const InPlaneStrain strain{c(0, 0), c(1, 1), c(0, 1)};
  const double i1 = strain.a + strain.b + 1 / strain.det();
  const Vec3 slope = in_plane_stress(law.response(constants, i1, strain.a), strain).first;
  Mat2 s;
  s << 2 * slope[0], slope[2], slope[2], 2 * slope[1];
  return principal(f * s * f.transpose());
}

}  // namespace

Strain measure_strain(const Model &model, const std::vector<Vec3> &x) {
  const Valve &valve = model.valve;
  Strain strain;
  for (size_t t = 0; t < valve.triangles.size(); ++t) {
    const Sides rest = sides_in_plane(valve.rest, valve.triangles[t]);
    const Sides now = sides_in_plane(x, valve.triangles[t]);
    const Leaflet &leaflet = valve.leaflets[valve.triangle_leaflet[t]];
    const LeafletLaw &law = *find_leaflet_law(leaflet.law);
    strain.stretch.push_back(principal_stretches(rest, now));
    strain.stress.push_back(
        law.response ? principal_stresses(law, leaflet.constants, rest_inverse(valve, t), now)
                     : principal_stresses(Bilinear(leaflet.constants), rest, now));
    strain.max_strain = std::max(strain.max_strain, strain.stretch[t][0] - 1);
    strain.max_stress = std::max(strain.max_stress, strain.stress[t][0]);
    strain.leaflet_area += 0.5 * std::abs(now(0, 0) * now(1, 2));
  }
  return strain;
}

}  // namespace mvs::core
