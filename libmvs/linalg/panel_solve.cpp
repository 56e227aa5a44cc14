// Solving with factorised panels: a few columns by themselves, then what they give to the rows
// below, which is held in registers while all of them pass.
#include <algorithm>
#include <array>
#include <type_traits>

#include "base/simd.h"
#include "base/simd_level.h"
#include "linalg/panel.h"

namespace mvs::core {
namespace {

constexpr size_t block_columns = 12;  // a multiple of 3: columns come three at a time

// Three numbers by the square of their columns a, b, c, from row j on.
MVS_INLINE void forward_square(const double *a, const double *b, const double *c, size_t j,
                               double *x) {
  x[j] *= a[j];
  x[j + 1] = (x[j + 1] - a[j + 1] * x[j]) * b[j + 1];
  x[j + 2] = (x[j + 2] - a[j + 2] * x[j] - b[j + 2] * x[j + 1]) * c[j + 2];
}

// The square of floats is inverse.
MVS_INLINE void forward_square(const float *a, const float *b, const float *c, size_t j, float *x) {
  const float x0 = x[j], x1 = x[j + 1], x2 = x[j + 2];
  x[j] = a[j] * x0;
  x[j + 1] = a[j + 1] * x0 + b[j + 1] * x1;
  x[j + 2] = (a[j + 2] * x0 + b[j + 2] * x1) + c[j + 2] * x2;
}

// Columns first .. last by themselves.
template <typename T>
MVS_INLINE void forward_block(const T *panel, size_t height, size_t first, size_t last, T *x) {
  for (size_t j = first; j < last; j += 3) {
    const T *a = panel + j * height, *b = a + height, *c = b + height;
    forward_square(a, b, c, j, x);
    const T x0 = x[j], x1 = x[j + 1], x2 = x[j + 2];
    for (size_t i = j + 3; i < last; ++i) x[i] = x[i] - a[i] * x0 - b[i] * x1 - c[i] * x2;
  }
}

// x[i] -= sum_k a[i, k] by[k] for as many rows as `count` vectors have.
template <typename V, size_t count, typename T = typename V::Number>
MVS_INLINE void take_from(const T *a, size_t height, size_t columns, const T *by, T *x) {
  typename V::Value sum[count], of_a;
  for (size_t v = 0; v < count; ++v) load<V>(sum[v], x + v * V::lanes);
  for (size_t k = 0; k < columns; ++k, a += height) {
    for (size_t v = 0; v < count; ++v) {
      load<V>(of_a, a + v * V::lanes);
      sum[v] -= of_a * by[k];
    }
  }
  for (size_t v = 0; v < count; ++v) store<V>(x + v * V::lanes, sum[v]);
}

// Whole vectors to the end: what lies past it is nobody's.
template <typename V, typename T = typename V::Number>
MVS_INLINE void forward(const T *panel, size_t width, size_t height, T *x) {
  constexpr size_t lanes = V::lanes;
  for (size_t first = 0; first < width; first += block_columns) {
    const size_t last = std::min(first + block_columns, width), columns = last - first;
    forward_block(panel, height, first, last, x);
    const T *a = panel + first * height, *by = x + first;
    size_t i = last;
    for (; i + 3 * lanes < height; i += 4 * lanes) {
      take_from<V, 4>(a + i, height, columns, by, x + i);
    }
    if (i + 2 * lanes < height) {
      take_from<V, 3>(a + i, height, columns, by, x + i);
    } else if (i + lanes < height) {
      take_from<V, 2>(a + i, height, columns, by, x + i);
    } else if (i < height) {
      take_from<V, 1>(a + i, height, columns, by, x + i);
    }
  }
}

// What the rows below take from three columns: from the last row on.
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

// From what the rows below leave of three numbers, by the square of their columns from row j on.
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

// Columns first .. last, of which x has what the rows from `last` on leave: three at a time, their
// sums do not wait for each other.
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

using Eight = Wide<float, 8, 1>;

struct Sums {
  Eight::Value of_a = {}, of_b = {}, of_c = {};
};

// Eight rows of three columns, or what there is of them.
MVS_INLINE void add_rows(const float *a, size_t height, const float *x, size_t rows, Sums &sum) {
  Eight::Value of_x, of_a, of_b, of_c;
  load<Eight>(of_x, x);
  load<Eight>(of_a, a);
  load<Eight>(of_b, a + height);
  load<Eight>(of_c, a + 2 * height);
  if (rows < Eight::lanes) {
    keep_first(of_x, rows);
    keep_first(of_a, rows);
    keep_first(of_b, rows);
    keep_first(of_c, rows);
  }
  sum.of_a += of_a * of_x;
  sum.of_b += of_b * of_x;
  sum.of_c += of_c * of_x;
}

// to[k] -= sum_i a[i, k] x[i] for three columns k, i first .. height. In eight sums each, whatever
// the processor: the bits are the same on all of them.
MVS_INLINE void take_below(const float *a, size_t height, size_t first, const float *x, float *to) {
  Sums sum;
  size_t i = first;
  for (; i + Eight::lanes <= height; i += Eight::lanes) {
    add_rows(a + i, height, x + i, Eight::lanes, sum);
  }
  if (i < height) add_rows(a + i, height, x + i, height - i, sum);
  to[0] -= sum_of<Eight>(sum.of_a);
  to[1] -= sum_of<Eight>(sum.of_b);
  to[2] -= sum_of<Eight>(sum.of_c);
}

template <typename T>
MVS_INLINE void backward(const T *panel, size_t width, size_t height, T *x) {
  if constexpr (std::is_same_v<T, double>) {
    backward_block(panel, height, 0, width, height, x);
  } else {
    for (size_t last = width; last > 0;) {
      const size_t first = (last - 1) / block_columns * block_columns;
      for (size_t j = first; j < last; j += 3) {
        take_below(panel + j * height, height, last, x, x + j);
      }
      backward_block(panel, height, first, last, last, x);
      last = first;
    }
  }
}

template <typename T>
struct Kernels {
  void (*forward)(const T *, size_t, size_t, T *);
  void (*backward)(const T *, size_t, size_t, T *);
};

// The kernels compiled for a target with V its vectors. Attributes cannot be in parentheses.
// NOLINTBEGIN(bugprone-macro-parentheses)
#define MVS_KERNELS(Name, ATTRIBUTE)                                       \
  template <typename V>                                                    \
  struct Name {                                                            \
    using T = typename V::Number;                                          \
    ATTRIBUTE static void forward(const T *p, size_t w, size_t h, T *x) {  \
      mvs::core::forward<V>(p, w, h, x);                                   \
    }                                                                      \
    ATTRIBUTE static void backward(const T *p, size_t w, size_t h, T *x) { \
      mvs::core::backward(p, w, h, x);                                     \
    }                                                                      \
    static Kernels<T> all() { return {&forward, &backward}; }              \
  }

// NOLINTEND(bugprone-macro-parentheses)

MVS_KERNELS(Plain, );
#if defined(__x86_64__) && defined(__GNUC__)
MVS_KERNELS(Wider, [[gnu::target("avx2")]]);
MVS_KERNELS(Widest, [[gnu::target("avx512f")]]);
#endif

template <typename T>
Kernels<T> choose() {
  constexpr size_t sse = 16 / sizeof(T);
#if defined(__x86_64__) && defined(__GNUC__)
  if (simd_level() == SimdLevel::avx512) return Widest<Wide<T, 4 * sse, 1>>::all();
  if (simd_level() >= SimdLevel::avx2) return Wider<Wide<T, 2 * sse, 1>>::all();
#endif
  return Plain<Wide<T, sse, 1>>::all();
}

template <typename T>
const Kernels<T> &kernels() {
  static const Kernels<T> chosen = choose<T>();
  return chosen;
}

}  // namespace

template <typename T>
void solve_forward(const T *panel, size_t width, size_t height, T *x) {
  kernels<T>().forward(panel, width, height, x);
}

template <typename T>
void solve_backward(const T *panel, size_t width, size_t height, T *x) {
  kernels<T>().backward(panel, width, height, x);
}

template void solve_forward(const double *, size_t, size_t, double *);
template void solve_forward(const float *, size_t, size_t, float *);
template void solve_backward(const double *, size_t, size_t, double *);
template void solve_backward(const float *, size_t, size_t, float *);

}  // namespace mvs::core
