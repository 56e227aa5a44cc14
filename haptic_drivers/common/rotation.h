// Rotation matrix to quaternion, and a check of forces; both for use at the device's rate.
#pragma once

#include <mvs/driver.h>

#include <cmath>

namespace driver {

// Writes the quaternion w x y z of the rotation matrix m[row][column]. Divides by the largest of
// the four components only (Shepperd 1978). NaN in the matrix gives NaN.
inline void quaternion(const double m[3][3], double *q) {
  const double squares[4] = {m[0][0] + m[1][1] + m[2][2], m[0][0] - m[1][1] - m[2][2],
                             m[1][1] - m[0][0] - m[2][2], m[2][2] - m[0][0] - m[1][1]};
  int k = 0;
  for (int i = 1; i < 4; ++i)
    if (squares[i] > squares[k]) k = i;
  const double twice = std::sqrt(1 + squares[k]), half = 0.5 / twice;
  const double x = m[2][1] - m[1][2], y = m[0][2] - m[2][0], z = m[1][0] - m[0][1];
  const double xy = m[0][1] + m[1][0], xz = m[0][2] + m[2][0], yz = m[1][2] + m[2][1];
  const double rows[4][4] = {{0, x, y, z}, {x, 0, xy, xz}, {y, xy, 0, yz}, {z, xz, yz, 0}};
  for (int i = 0; i < 4; ++i) q[i] = i == k ? 0.5 * twice : rows[k][i] * half;
}

// Returns whether force and torque are finite.
inline bool is_finite(const mvs_driver_force &force) {
  for (int i = 0; i < 3; ++i)
    if (!std::isfinite(force.force[i]) || !std::isfinite(force.torque[i])) return false;
  return true;
}

}  // namespace driver
