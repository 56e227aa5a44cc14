// Exact integration of a mass on a spring and damper whose other end moves:
//
//   m x'' = -k (x - s) - c (x' - s') - b x' + u,   s'' = -w^2 s
//
// with constant u and the arm's end s at rest, in uniform motion (w = 0) or in a sine. The system
// is linear: its state after h is exp(A h) times the state before, up to rounding. An integrator
// with numerical energy gain could not distinguish a stable servo from an unstable one.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

namespace hand {

struct Oscillator {
  double mass = 1;         // m, kg
  double stiffness = 0;    // k, N/m
  double arm_damping = 0;  // c, N s/m, between the mass and the arm's end
  double damping = 0;      // b, N s/m, between the mass and the ground
  double swing = 0;        // w, rad/s
};

// Coefficients of x and v after an interval, over x, v, u, s, s' before it.
struct Step {
  std::array<double, 5> x, v;
};

using Matrix = std::array<std::array<double, 5>, 5>;

inline Matrix operator*(const Matrix &a, const Matrix &b) {
  Matrix out = {};
  for (int i = 0; i < 5; ++i)
    for (int k = 0; k < 5; ++k)
      for (int j = 0; j < 5; ++j) out[i][j] += a[i][k] * b[k][j];
  return out;
}

// exp(a) by scaling and squaring; `norm` bounds the row sums of |a|.
inline Matrix exponential(Matrix a, double norm) {
  int squarings = 0;
  while (norm > 0.25 && squarings < 200) {
    norm /= 2;
    ++squarings;
  }
  for (auto &row : a)
    for (double &value : row) value = std::ldexp(value, -squarings);
  Matrix unit = {}, sum;
  for (int i = 0; i < 5; ++i) unit[i][i] = 1;
  sum = unit;
  // Horner: the 13th term of the series is below 0.25^13 / 13! = 2e-18
  for (int n = 12; n > 0; --n) {
    sum = a * sum;
    for (auto &row : sum)
      for (double &value : row) value /= n;
    for (int i = 0; i < 5; ++i) sum[i][i] += 1;
  }
  for (; squarings > 0; --squarings) sum = sum * sum;
  return sum;
}

inline Step step(const Oscillator &o, double h) {
  const double m = o.mass, drag = (o.arm_damping + o.damping) / m;
  // velocities are scaled by r and u by m r^2, so that all entries of A have the same magnitude
  const double r = std::max({std::sqrt(o.stiffness / m), drag, o.swing, 1.0});
  Matrix a = {};
  a[0][1] = r * h;
  a[1] = {-o.stiffness / m / r * h, -drag * h, r * h, o.stiffness / m / r * h,
          o.arm_damping / m * h};
  a[3][4] = r * h;
  a[4][3] = -o.swing * o.swing / r * h;
  const Matrix e = exponential(a, 5 * r * h);
  const std::array<double, 5> unit = {1, 1 / r, 1 / (m * r * r), 1, 1 / r};
  Step out;
  for (int j = 0; j < 5; ++j) {
    out.x[j] = e[0][j] * unit[j];
    out.v[j] = e[1][j] * unit[j] * r;
  }
  return out;
}

}  // namespace hand
