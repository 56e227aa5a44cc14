// Cholesky factorisation without pivoting (Golub and Van Loan, Matrix Computations, 2013, 4.2).
#include "patient/fit/normal_equations.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace mvs::core {

std::vector<double> solve_dense(const DenseMatrix &h, const std::vector<double> &b) {
  const size_t n = h.size;
  DenseMatrix l = h;
  for (size_t j = 0; j < n; ++j) {
    for (size_t k = 0; k < j; ++k) l.at(j, j) -= l.at(j, k) * l.at(j, k);
    l.at(j, j) = std::sqrt(l.at(j, j));
    for (size_t i = j + 1; i < n; ++i) {
      for (size_t k = 0; k < j; ++k) l.at(i, j) -= l.at(i, k) * l.at(j, k);
      l.at(i, j) /= l.at(j, j);
    }
  }
  std::vector<double> x = b;
  for (size_t i = 0; i < n; ++i) {
    for (size_t k = 0; k < i; ++k) x[i] -= l.at(i, k) * x[k];
    x[i] /= l.at(i, i);
  }
  for (size_t i = n; i-- > 0;) {
    for (size_t k = i + 1; k < n; ++k) x[i] -= l.at(k, i) * x[k];
    x[i] /= l.at(i, i);
  }
  return x;
}

std::vector<double> solve_bounded(const DenseMatrix &h, const std::vector<double> &b,
                                  const std::vector<double> &low, const std::vector<double> &high) {
  const size_t n = h.size;
  std::vector<uint8_t> held(n, 0);
  std::vector<double> x(n, 0);
  for (size_t round = 0; round <= n; ++round) {
    DenseMatrix rest = h;
    std::vector<double> right = b;
    for (size_t i = 0; i < n; ++i) {
      for (size_t j = 0; j < n; ++j) {
        if (!held[i] && held[j]) right[i] -= h.at(i, j) * x[j];
        if (held[i] || held[j]) rest.at(i, j) = i == j ? 1 : 0;
      }
    }
    for (size_t i = 0; i < n; ++i) {
      if (held[i]) right[i] = x[i];
    }
    x = solve_dense(rest, right);
    bool inside = true;
    for (size_t i = 0; i < n; ++i) {
      if (x[i] >= low[i] && x[i] <= high[i]) continue;
      x[i] = std::clamp(x[i], low[i], high[i]);
      inside = inside && held[i];
      held[i] = 1;
    }
    if (inside) break;
  }
  return x;
}

std::vector<double> inverse_diagonal(const DenseMatrix &h) {
  std::vector<double> diagonal;
  for (size_t k = 0; k < h.size; ++k) {
    std::vector<double> unit(h.size, 0);
    unit[k] = 1;
    diagonal.push_back(solve_dense(h, unit)[k]);
  }
  return diagonal;
}

}  // namespace mvs::core
