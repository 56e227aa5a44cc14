// Elimination by rows: each row takes multiples of the rows above it.
#include "sensitivity/dense_factor.h"

#include <cmath>

namespace mvs::core {

DenseFactor::DenseFactor(size_t n, std::vector<double> a) : n_(n), a_(std::move(a)), pivot_(n) {
  for (size_t k = 0; k < n; ++k) {
    size_t best = k;
    for (size_t i = k + 1; i < n; ++i) {
      if (std::abs(a_[i * n + k]) > std::abs(a_[best * n + k])) best = i;
    }
    pivot_[k] = best;
    if (best != k) {
      for (size_t j = 0; j < n; ++j) std::swap(a_[k * n + j], a_[best * n + j]);
    }
    const double *top = &a_[k * n];
    if (!(std::abs(top[k]) > 0)) {
      is_regular_ = false;
      return;
    }
    for (size_t i = k + 1; i < n; ++i) {
      double *row = &a_[i * n];
      const double factor = row[k] /= top[k];
      if (factor == 0) continue;
      for (size_t j = k + 1; j < n; ++j) row[j] -= factor * top[j];
    }
  }
}

void DenseFactor::solve(std::vector<double> &b) const {
  for (size_t k = 0; k < n_; ++k) std::swap(b[k], b[pivot_[k]]);
  for (size_t i = 0; i < n_; ++i) {
    for (size_t j = 0; j < i; ++j) b[i] -= a_[i * n_ + j] * b[j];
  }
  for (size_t i = n_; i-- > 0;) {
    for (size_t j = i + 1; j < n_; ++j) b[i] -= a_[i * n_ + j] * b[j];
    b[i] /= a_[i * n_ + i];
  }
}

}  // namespace mvs::core
