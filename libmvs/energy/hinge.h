// Angle of a hinge and its derivatives, as in Tamstorf & Grinspun, Graphical Models 75, 2013; the
// Hessian is derived here from the gradient. Nodes: the edge x0 x1, then the corners x2 and x3.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <numbers>

#include "base/simd.h"
#include "linalg/outer_product.h"

namespace mvs::core {

// Quantities that the angle of a hinge and its gradient need. N1 = e x (x2 - x0), N2 = (x3 - x0) x
// e.
struct HingeFold {
  Vec3 e, c2, c3, n1, n2;  // c = x - x0
  double length = 0;

  HingeFold() = default;
  HingeFold(const Vec3 &x0, const Vec3 &x1, const Vec3 &x2, const Vec3 &x3)
      : e(x1 - x0), c2(x2 - x0), c3(x3 - x0), n1(e.cross(c2)), n2(c3.cross(e)), length(e.norm()) {}

  // The sine and cosine of the angle, both times |N1| |N2|: N1 x N2 = -e (N1 c3).
  double sine() const { return 0 - length * n1.dot(c3); }
  double cosine() const { return n1.dot(n2); }

  // Gradient of the angle by nodes. s is the position of the foot of a corner along the edge, m.
  MVS_INLINE void slopes(Slope &slope) const {
    const double per_length = 1 / length, s2 = c2.dot(e) * per_length, s3 = c3.dot(e) * per_length;
    const Vec3 m1 = 1 / n1.squaredNorm() * n1, m2 = 1 / n2.squaredNorm() * n2;
    slope.node(0) = (length - s2) * m1 + (length - s3) * m2;
    slope.node(1) = s2 * m1 + s3 * m2;
    slope.node(2) = -length * m1;
    slope.node(3) = -length * m2;
  }
};

// Those that the Hessian needs as well.
struct HingeParts : HingeFold {
  double q1 = 0, q2 = 0;           // |N|^2
  Vec3 m1, m2;                     // N / |N|^2
  std::array<double, 4> a{}, b{};  // dtheta/dx_k = a_k m1 + b_k m2

  HingeParts() = default;
  HingeParts(const Vec3 &x0, const Vec3 &x1, const Vec3 &x2, const Vec3 &x3)
      : HingeFold(x0, x1, x2, x3),
        q1(n1.squaredNorm()),
        q2(n2.squaredNorm()),
        m1(n1 / q1),
        m2(n2 / q2) {
    const double s2 = c2.dot(e) / length, s3 = c3.dot(e) / length;
    // theta grows as x2 sinks below the fold
    a = {length - s2, s2, -length, 0};
    b = {length - s3, s3, 0, -length};
  }
};

// dm / dN
inline Mat3 slope_of_normal(const Vec3 &n, double norm2) {
  return (Mat3::Identity() - (2 / norm2) * n * n.transpose()) / norm2;
}

// Derivatives of the weights a or b of one triangle with respect to the two ends of the edge: of
// that of the first end (by the first end alone), of the second end and of the corner.
struct WeightSlopes {
  Vec3 first;
  std::array<Vec3, 2> second, corner;
};

// `c` is the corner, from the first end of the edge.
inline WeightSlopes slopes_of_weights(const Vec3 &e, double length, const Vec3 &c) {
  const Vec3 u = e / length;
  const double s = c.dot(u);
  const Vec3 ds_de = (c - s * u) / length;
  const Vec3 ds_of_first = -ds_de - u;  // c moves with the first end as well
  return {-u - ds_of_first, {ds_of_first, ds_de}, {u, -u}};
}

// m times the matrix of the cross product with v.
inline Mat3 times_cross(const Mat3 &m, const Vec3 &v) {
  Mat3 product;
  product.col(0) = m.col(1) * v.z() - m.col(2) * v.y();
  product.col(1) = m.col(2) * v.x() - m.col(0) * v.z();
  product.col(2) = m.col(0) * v.y() - m.col(1) * v.x();
  return product;
}

using HingeHessian = std::array<std::array<Mat3, 4>, 4>;

// Second derivative of theta: blocks (k, l) with l <= k. A corner does not move the triangle of the
// other one.
MVS_INLINE void angle_hessian(const HingeParts &p, HingeHessian &h) {
  const WeightSlopes da = slopes_of_weights(p.e, p.length, p.c2);
  const WeightSlopes db = slopes_of_weights(p.e, p.length, p.c3);
  // N1 = e x c2: dN1 = -[c2]x de + [e]x dc2; N2 = c3 x e: dN2 = [c3]x de - [e]x dc3.
  const Mat3 dm1 = slope_of_normal(p.n1, p.q1), dm2 = slope_of_normal(p.n2, p.q2);
  const std::array<Mat3, 2> d1{times_cross(dm1, p.c2 - p.e), times_cross(dm1, -p.c2)};
  const std::array<Mat3, 2> d2{times_cross(dm2, p.e - p.c3), times_cross(dm2, p.c3)};
  h[0][0] =
      p.m1 * da.first.transpose() + p.m2 * db.first.transpose() + p.a[0] * d1[0] + p.b[0] * d2[0];
  for (uint32_t l = 0; l < 2; ++l) {
    h[1][l] = p.m1 * da.second[l].transpose() + p.m2 * db.second[l].transpose() + p.a[1] * d1[l] +
              p.b[1] * d2[l];
    h[2][l] = p.m1 * da.corner[l].transpose() + p.a[2] * d1[l];
    h[3][l] = p.m2 * db.corner[l].transpose() + p.b[3] * d2[l];
  }
  h[2][2] = p.a[2] * times_cross(dm1, p.e);
  h[3][2].setZero();
  h[3][3] = p.b[3] * times_cross(dm2, -p.e);
}

// The difference of two angles in (-pi, pi].
inline double wrap_angle(double angle) {
  if (std::abs(angle) <= std::numbers::pi) return angle;
  return angle > 0 ? angle - 2 * std::numbers::pi : angle + 2 * std::numbers::pi;
}

}  // namespace mvs::core
