// Forward solution with the columns of one block of a factorised panel, on their own, for
// panel_solve.cpp and compact_panel.cpp.
#pragma once

#include <cstddef>

#include "base/simd.h"

namespace mvs::core {

inline constexpr size_t solve_columns = 12;  // a multiple of 3: columns come three at a time

// Solves for three numbers by the square of their columns a, b, c, from row j on.
MVS_INLINE void forward_square(const double *a, const double *b, const double *c, size_t j,
                               double *x) {
  x[j] *= a[j];
  x[j + 1] = (x[j + 1] - a[j + 1] * x[j]) * b[j + 1];
  x[j + 2] = (x[j + 2] - a[j + 2] * x[j] - b[j + 2] * x[j + 1]) * c[j + 2];
}

// The square of floats is an inverse.
MVS_INLINE void forward_square(const float *a, const float *b, const float *c, size_t j, float *x) {
  const float x0 = x[j], x1 = x[j + 1], x2 = x[j + 2];
  x[j] = a[j] * x0;
  x[j + 1] = a[j + 1] * x0 + b[j + 1] * x1;
  x[j + 2] = (a[j + 2] * x0 + b[j + 2] * x1) + c[j + 2] * x2;
}

// Solves for columns first .. last on their own.
template <typename T>
MVS_INLINE void forward_block(const T *panel, size_t height, size_t first, size_t last, T *x) {
  for (size_t j = first; j < last; j += 3) {
    const T *a = panel + j * height, *b = a + height, *c = b + height;
    forward_square(a, b, c, j, x);
    const T x0 = x[j], x1 = x[j + 1], x2 = x[j + 2];
    for (size_t i = j + 3; i < last; ++i) x[i] = x[i] - a[i] * x0 - b[i] * x1 - c[i] * x2;
  }
}

}  // namespace mvs::core
