// Kinematics of a membrane triangle and its second Piola-Kirchhoff response. With F = [f0 f1] the
// map from the rest triangle (first axis along the fibre) into space, three numbers determine the
// response:
//     a = f0 . f0,  b = f1 . f1,  c = f0 . f1,
// the in-plane Cauchy-Green strain C = [a c; c b]. The tissue is incompressible and in plane
// stress, so that the thickness is scaled by 1 / sqrt(det C):
//     I1 = a + b + 1 / (a b - c^2),  I4 = a.
#pragma once

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "model/model.h"

namespace mvs::core {

using Mat2 = Eigen::Matrix2d;

// Energy density and its derivatives with respect to (a, b, c).
struct InPlane {
  double w;
  Vec3 first;
  Mat3 second;
};

struct InPlaneStrain {
  double a, b, c;
  double det() const { return a * b - c * c; }
};

// Returns energy density and gradient; `second` is not set.
inline InPlane in_plane_stress(const Response &r, const InPlaneStrain &s) {
  const double d = 1 / s.det(), d2 = d * d;
  InPlane out;
  out.w = r.w;
  out.first = {r.w1 * (1 - s.b * d2) + r.w4, r.w1 * (1 - s.a * d2), 2 * r.w1 * s.c * d2};
  return out;
}

// Returns energy density, gradient and Hessian. W is convex in (a, b, c) for every law of law.h,
// since I1 is convex in C, I4 is linear, and W increases in I1 and is jointly convex: `second` is
// positive semidefinite. Its entries are w1 d2I1 + w11 dI1 dI1 + w14 (dI1 dI4 + dI4 dI1) + w44 dI4
// dI4.
inline InPlane in_plane_stiffness(const Response &r, const InPlaneStrain &s) {
  const auto [a, b, c] = s;
  const double d = 1 / s.det(), d2 = d * d, k = 2 * r.w1 * d2 * d;
  const double p = 1 - b * d2, q = 1 - a * d2,
               u = 2 * c * d2;  // derivatives of I1 with respect to a, b, c
  InPlane out;
  out.w = r.w;
  out.first = {r.w1 * p + r.w4, r.w1 * q, r.w1 * u};
  const double aa = k * b * b + (r.w11 * p + 2 * r.w14) * p + r.w44;
  const double ab = k * a * b - r.w1 * d2 + (r.w11 * p + r.w14) * q;
  const double ac = -2 * k * b * c + (r.w11 * p + r.w14) * u;
  const double bb = k * a * a + r.w11 * q * q;
  const double bc = -2 * k * a * c + r.w11 * q * u;
  const double cc = 2 * r.w1 * d2 + 4 * k * c * c + r.w11 * u * u;
  out.second << aa, ab, ac, ab, bb, bc, ac, bc, cc;
  return out;
}

// Inverse of the matrix of rest sides 0-1 and 0-2 in the triangle's axes: fibre, normal x fibre. F
// = [x1 - x0, x2 - x0] times this inverse.
inline Mat2 rest_inverse(const Valve &valve, size_t t) {
  const Tri &nodes = valve.triangles[t];
  const Vec3 s1 = valve.rest[nodes[1]] - valve.rest[nodes[0]];
  const Vec3 s2 = valve.rest[nodes[2]] - valve.rest[nodes[0]];
  const Vec3 &fibre = valve.triangle_fibre[t];
  const Vec3 across = s1.cross(s2).normalized().cross(fibre);
  Mat2 sides;
  sides << fibre.dot(s1), fibre.dot(s2), across.dot(s1), across.dot(s2);
  return sides.inverse();
}

}  // namespace mvs::core
