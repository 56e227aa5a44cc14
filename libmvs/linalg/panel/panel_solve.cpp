// Triangular solution with factorised panels: a few columns on their own, then their products with
// the rows below, which stay in registers for all of these columns.
#include <algorithm>
#include <array>
#include <type_traits>

#include "base/simd.h"
#include "linalg/panel/panel.h"
#include "linalg/panel/panel_block.h"

namespace mvs::core {
namespace {

// x[i] -= sum_k a[i, k] by[k] for the rows of `count` registers.
template <typename V, size_t count, typename T = typename V::Number>
MVS_INLINE void take_from(const T *a, size_t height, size_t columns, const T *by, T *x) {
  typename V::Value sum[count], of_a;
  for (size_t v = 0; v < count; ++v) load<V>(sum[v], x + v * V::width);
  for (size_t k = 0; k < columns; ++k, a += height) {
    for (size_t v = 0; v < count; ++v) {
      load<V>(of_a, a + v * V::width);
      sum[v] -= of_a * by[k];
    }
  }
  for (size_t v = 0; v < count; ++v) store<V>(x + v * V::width, sum[v]);
}

// Rows i to `rows`. Whole registers to the end: numbers past it are padding.
template <typename V, typename T = typename V::Number>
MVS_INLINE void take_from_rows(const T *a, size_t height, size_t columns, size_t i, size_t rows,
                               const T *by, T *x) {
  constexpr size_t wide = V::width;
  for (; i + 3 * wide < rows; i += 4 * wide) {
    take_from<V, 4>(a + i, height, columns, by, x + i);
  }
  if (i + 2 * wide < rows) {
    take_from<V, 3>(a + i, height, columns, by, x + i);
  } else if (i + wide < rows) {
    take_from<V, 2>(a + i, height, columns, by, x + i);
  } else if (i < rows) {
    take_from<V, 1>(a + i, height, columns, by, x + i);
  }
}

template <typename V, typename T = typename V::Number>
MVS_INLINE void forward_columns(const T *panel, size_t width, size_t height, size_t rows, T *x) {
  for (size_t first = 0; first < width; first += solve_columns) {
    const size_t last = std::min(first + solve_columns, width);
    forward_block(panel, height, first, last, x);
    take_from_rows<V>(panel + first * height, height, last - first, last, rows, x + first, x);
  }
}

template <typename V, typename T = typename V::Number>
MVS_INLINE void forward_rows(const T *row, size_t width, size_t height, size_t rows, const T *y,
                             T *x) {
  for (size_t first = 0; first < width; first += solve_columns) {
    const size_t columns = std::min(solve_columns, width - first);
    take_from_rows<V>(row + first * height, height, columns, 0, rows, y + first, x);
  }
}

// Subtracts the products of three columns with the rows below, from the last row on.
template <typename T>
MVS_INLINE void take_rows(const T *a, size_t height, size_t first, size_t last, const T *x,
                          std::array<T, 3> &sum) {
  const T *b = a + height, *c = b + height;
  for (size_t i = last; i-- > first;) {
    sum[0] -= a[i] * x[i];
    sum[1] -= b[i] * x[i];
    sum[2] -= c[i] * x[i];
  }
}

// Solves for three numbers, of which `sum` is left, by the square of their columns from row j on.
MVS_INLINE void backward_square(const double *a, const double *b, const double *c, size_t j,
                                const std::array<double, 3> &sum, double *x) {
  x[j + 2] = sum[2] * c[j + 2];
  x[j + 1] = (sum[1] - b[j + 2] * x[j + 2]) * b[j + 1];
  x[j] = (sum[0] - a[j + 2] * x[j + 2] - a[j + 1] * x[j + 1]) * a[j];
}

MVS_INLINE void backward_square(const float *a, const float *b, const float *c, size_t j,
                                const std::array<float, 3> &sum, float *x) {
  x[j + 2] = sum[2] * c[j + 2];
  x[j + 1] = sum[2] * b[j + 2] + sum[1] * b[j + 1];
  x[j] = (sum[2] * a[j + 2] + sum[1] * a[j + 1]) + sum[0] * a[j];
}

// The same for six columns, two in a register.
MVS_INLINE void take_rows(const double *a, size_t height, size_t first, size_t last,
                          const double *x, std::array<double, 6> &sum) {
  size_t i = last;
#if defined(__GNUC__)
  Double2::Value pair[3], of_x, left, right;
  for (size_t k = 0; k < 3; ++k) load<Double2>(pair[k], sum.data() + 2 * k);
  for (; i >= first + 2; i -= 2) {
    load<Double2>(of_x, x + i - 2);
    for (size_t k = 0; k < 3; ++k) {
      load<Double2>(left, a + 2 * k * height + i - 2);
      load<Double2>(right, a + (2 * k + 1) * height + i - 2);
      left *= of_x;
      right *= of_x;
      pair[k] -= Double2::Value{left[1], right[1]};
      pair[k] -= Double2::Value{left[0], right[0]};
    }
  }
  for (size_t k = 0; k < 3; ++k) store<Double2>(sum.data() + 2 * k, pair[k]);
#endif
  while (i-- > first) {
    for (size_t k = 0; k < 6; ++k) sum[k] -= a[k * height + i] * x[i];
  }
}

// Solves for columns first .. last, without the products with rows from `last` on: three at a time,
// so that their sums are independent.
template <typename T>
MVS_INLINE void backward_block(const T *panel, size_t height, size_t first, size_t last,
                               size_t rows, T *x) {
  for (size_t j = last; j > first; j -= 3) {
    const T *a = panel + (j - 3) * height, *b = a + height, *c = b + height;
    std::array<T, 3> sum = {x[j - 3], x[j - 2], x[j - 1]};
    take_rows(a, height, j, rows, x, sum);
    backward_square(a, b, c, j - 3, sum, x);
  }
}

// The bits of backward_block() with half of the wait for the sums: six columns share the rows below
// them, then the first three take those of the other three.
MVS_INLINE void backward_by_six(const double *panel, size_t width, size_t height, double *x) {
  size_t j = width;
  for (; j >= 6; j -= 6) {
    const double *a = panel + (j - 6) * height, *d = a + 3 * height;
    std::array<double, 6> sum;
    for (size_t k = 0; k < 6; ++k) sum[k] = x[j - 6 + k];
    take_rows(a, height, j, height, x, sum);
    backward_square(d, d + height, d + 2 * height, j - 3, {sum[3], sum[4], sum[5]}, x);
    std::array<double, 3> rest = {sum[0], sum[1], sum[2]};
    take_rows(a, height, j - 3, j, x, rest);
    backward_square(a, a + height, a + 2 * height, j - 6, rest, x);
  }
  backward_block(panel, height, 0, j, height, x);
}

struct Sums {
  Float8::Value of_a = {}, of_b = {}, of_c = {};
};

// Adds the products of eight rows of three columns, or of the `rows` that remain.
MVS_INLINE void add_rows(const float *a, size_t height, const float *x, size_t rows, Sums &sum) {
  Float8::Value of_x, of_a, of_b, of_c;
  load<Float8>(of_x, x);
  load<Float8>(of_a, a);
  load<Float8>(of_b, a + height);
  load<Float8>(of_c, a + 2 * height);
  if (rows < Float8::width) {
    keep_first(of_x, rows);
    keep_first(of_a, rows);
    keep_first(of_b, rows);
    keep_first(of_c, rows);
  }
  sum.of_a += of_a * of_x;
  sum.of_b += of_b * of_x;
  sum.of_c += of_c * of_x;
}

// to[k] -= sum_i a[i, k] x[i] for three columns k, i first .. height, in eight sums each on every
// processor, so that the bits are the same.
MVS_INLINE void take_below(const float *a, size_t height, size_t first, const float *x, float *to) {
  Sums sum;
  size_t i = first;
  for (; i + Float8::width <= height; i += Float8::width) {
    add_rows(a + i, height, x + i, Float8::width, sum);
  }
  if (i < height) add_rows(a + i, height, x + i, height - i, sum);
  to[0] -= sum_of(sum.of_a);
  to[1] -= sum_of(sum.of_b);
  to[2] -= sum_of(sum.of_c);
}

template <typename T>
MVS_INLINE void backward_columns(const T *panel, size_t width, size_t height, T *x) {
  if constexpr (std::is_same_v<T, double>) {
    backward_by_six(panel, width, height, x);
  } else {
    for (size_t last = width; last > 0;) {
      const size_t first = (last - 1) / solve_columns * solve_columns;
      for (size_t j = first; j < last; j += 3) {
        take_below(panel + j * height, height, last, x, x + j);
      }
      backward_block(panel, height, first, last, last, x);
      last = first;
    }
  }
}

}  // namespace

template <typename T>
void solve_forward_to(const T *panel, size_t width, size_t height, size_t rows, T *x) {
  using R = Registers<T>;
  static const auto kernel =
      simd_kernel<&forward_columns<typename R::Baseline>, &forward_columns<typename R::Avx2>,
                  &forward_columns<typename R::Avx512>>();
  kernel(panel, width, height, rows, x);
}

template <typename T>
void solve_forward(const T *panel, size_t width, size_t height, T *x) {
  solve_forward_to(panel, width, height, height, x);
}

template <typename T>
void subtract_rows(const T *row, size_t width, size_t height, size_t rows, const T *y, T *x) {
  using R = Registers<T>;
  static const auto kernel =
      simd_kernel<&forward_rows<typename R::Baseline>, &forward_rows<typename R::Avx2>,
                  &forward_rows<typename R::Avx512>>();
  kernel(row, width, height, rows, y, x);
}

template <typename T>
void solve_backward(const T *panel, size_t width, size_t height, T *x) {
  static const auto kernel =
      simd_kernel<&backward_columns<T>, &backward_columns<T>, &backward_columns<T>>();
  kernel(panel, width, height, x);
}

template void solve_forward_to(const double *, size_t, size_t, size_t, double *);
template void solve_forward_to(const float *, size_t, size_t, size_t, float *);
template void subtract_rows(const double *, size_t, size_t, size_t, const double *, double *);
template void subtract_rows(const float *, size_t, size_t, size_t, const float *, float *);
template void solve_forward(const double *, size_t, size_t, double *);
template void solve_forward(const float *, size_t, size_t, float *);
template void solve_backward(const double *, size_t, size_t, double *);
template void solve_backward(const float *, size_t, size_t, float *);

}  // namespace mvs::core
