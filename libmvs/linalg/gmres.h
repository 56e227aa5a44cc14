// GMRES without restarts (Saad & Schultz, SIAM J. Sci. Stat. Comput. 7, 1986), for systems that a
// preconditioner almost solves.
#pragma once

#include <cmath>
#include <vector>

#include "base/math.h"
#include "base/types.h"

namespace mvs::core {

inline double dot(const std::vector<Vec3> &a, const std::vector<Vec3> &b) {
  double sum = 0;
  for (size_t i = 0; i < a.size(); ++i) sum += a[i].dot(b[i]);
  return sum;
}

// Solves A x = b in place of b, for apply(v) that returns A v, from x = 0, to
// |b - A x| <= tolerance |b| or `most` iterations. Returns the relative residual reached.
template <typename Apply>
double gmres(const Apply &apply, std::vector<Vec3> &b, int most, double tolerance) {
  const double size = std::sqrt(dot(b, b));
  if (size == 0) return 0;
  std::vector<std::vector<Vec3>> basis{b};
  for (Vec3 &v : basis[0]) v /= size;
  std::vector<std::vector<double>> h;        // columns of the triangular factor
  std::vector<std::array<double, 2>> turns;  // Givens rotations
  std::vector<double> rhs{size};
  while (static_cast<int>(h.size()) < most && std::abs(rhs.back()) > tolerance * size) {
    const size_t k = h.size();
    std::vector<Vec3> w = apply(basis[k]);
    std::vector<double> column(k + 2);
    for (size_t j = 0; j <= k; ++j) {
      column[j] = dot(w, basis[j]);
      for (size_t i = 0; i < w.size(); ++i) w[i] -= column[j] * basis[j][i];
    }
    column[k + 1] = std::sqrt(dot(w, w));
    for (Vec3 &v : w) v /= column[k + 1] > 0 ? column[k + 1] : 1.0;
    for (size_t j = 0; j < k; ++j) {
      const double a = column[j], c = column[j + 1];
      column[j] = turns[j][0] * a + turns[j][1] * c;
      column[j + 1] = -turns[j][1] * a + turns[j][0] * c;
    }
    const double r = math::hypot(column[k], column[k + 1]);
    if (!(r > 0)) break;
    turns.push_back({column[k] / r, column[k + 1] / r});
    column[k] = r;
    rhs.push_back(-turns[k][1] * rhs[k]);
    rhs[k] *= turns[k][0];
    h.push_back(std::move(column));
    basis.push_back(std::move(w));
  }
  std::vector<double> y(h.size());
  for (size_t k = h.size(); k-- > 0;) {
    y[k] = rhs[k];
    for (size_t j = k + 1; j < h.size(); ++j) y[k] -= h[j][k] * y[j];
    y[k] /= h[k][k];
  }
  for (Vec3 &v : b) v.setZero();
  for (size_t k = 0; k < y.size(); ++k) {
    for (size_t i = 0; i < b.size(); ++i) b[i] += y[k] * basis[k][i];
  }
  return std::abs(rhs.back()) / size;
}

}  // namespace mvs::core
