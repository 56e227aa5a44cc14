// Factorisation of a panel, by blocks of columns: products with the columns on the left by tiles in
// registers, then a few columns at a time on their own.
#include <algorithm>
#include <cmath>
#include <type_traits>

#include "base/simd.h"
#include "linalg/panel/panel.h"
#include "linalg/panel/panel_tile.h"

namespace mvs::core {
namespace {

// Rows of a panel, from one multiple of panel_rows to another.
struct Rows {
  size_t begin, end;
};

// Subtracts from columns first .. last of a panel the products with columns left .. first. Works on
// whole tiles: numbers above the diagonal are not used.
template <typename V, typename T = typename V::Number>
MVS_INLINE void subtract_left(T *panel, size_t height, size_t left, size_t first, size_t last,
                              Rows rows) {
  for (size_t k = left; k < first; k += slab_depth) {
    const size_t depth = std::min(slab_depth, first - k);
    const T *a = panel + k * height;
    for (size_t top = std::max(first / panel_rows * panel_rows, rows.begin); top < rows.end;
         top += slab_rows) {
      const size_t bottom = std::min(top + slab_rows, rows.end);
      for (size_t j = first; j < last; j += tile_columns) {
        T *c = panel + j * height;
        for (size_t i = std::max(top, j / panel_rows * panel_rows); i < bottom; i += V::height) {
          if (last - j >= tile_columns) {
            subtract_tile<V, tile_columns>(c + i, height, a + i, a + j, height, depth);
          } else {
            subtract_tile<V, 3>(c + i, height, a + i, a + j, height, depth);
          }
        }
      }
    }
  }
}

// The square on the diagonal of some columns: L, and 1 / its diagonal.
template <size_t columns, typename T>
struct Square {
  T l[columns][columns];  // [column][row]

  MVS_INLINE bool factorise(const T *panel, size_t height, size_t first) {
    for (size_t j = 0; j < columns; ++j) {
      for (size_t i = j; i < columns; ++i) l[j][i] = panel[(first + j) * height + first + i];
    }
    for (size_t j = 0; j < columns; ++j) {
      for (size_t k = 0; k < j; ++k) {
        for (size_t i = j; i < columns; ++i) l[j][i] -= l[k][i] * l[k][j];
      }
      const T pivot = l[j][j];
      if (!(pivot > 0) || !std::isfinite(pivot)) return false;
      l[j][j] = 1 / std::sqrt(pivot);
      for (size_t i = j + 1; i < columns; ++i) l[j][i] *= l[j][j];
    }
    return true;
  }

  // Reads the square of factorised columns.
  MVS_INLINE void read(const T *panel, size_t height, size_t first) {
    for (size_t j = 0; j < columns; ++j) {
      for (size_t i = j; i < columns; ++i) l[j][i] = panel[(first + j) * height + first + i];
    }
  }
};

// Multiplies rows of some columns by the inverse of their square.
template <typename V, size_t columns, typename T = typename V::Number>
MVS_INLINE void solve_columns_of(const Square<columns, T> &square, T *c, size_t height, Rows rows) {
  for (size_t i = rows.begin; i < rows.end; i += V::width) {
    typename V::Value of[columns];
    for (size_t j = 0; j < columns; ++j) load<V>(of[j], c + j * height + i);
    for (size_t j = 0; j < columns; ++j) {
      for (size_t k = 0; k < j; ++k) of[j] -= of[k] * square.l[k][j];
      of[j] *= square.l[j][j];
    }
    for (size_t j = 0; j < columns; ++j) store<V>(c + j * height + i, of[j]);
  }
}

// Factorises some columns on their own: their square, then all rows to `end` by it, those of the
// square too, whose diagonal is stored last.
template <typename V, size_t columns, typename T = typename V::Number>
MVS_INLINE bool factorise_columns(T *panel, size_t height, size_t first, size_t end) {
  Square<columns, T> square;
  if (!square.factorise(panel, height, first)) return false;
  T *c = panel + first * height;
  solve_columns_of<V, columns>(square, c, height, {first / panel_rows * panel_rows, end});
  for (size_t j = 0; j < columns; ++j) c[j * height + first + j] = square.l[j][j];
  return true;
}

// Inverts the 3x3 squares on the diagonal, so that the three numbers of a solution do not depend on
// each other.
MVS_INLINE void invert_squares(float *panel, size_t width, size_t height) {
  for (size_t j = 0; j < width; j += 3) {
    float *a = panel + j * height + j, *b = a + height, *c = b + height;
    const float to_last = a[2] * a[0];
    a[1] *= -a[0] * b[1];
    a[2] = -(to_last + b[2] * a[1]) * c[2];
    b[2] *= -b[1] * c[2];
  }
}

template <typename T>
MVS_INLINE void finish(T *panel, size_t width, size_t height) {
  if constexpr (std::is_same_v<T, float>) invert_squares(panel, width, height);
}

// Rows of a block of columns down to `bottom`, its square included, by tiles of columns.
template <typename V, typename T = typename V::Number>
MVS_INLINE bool factorise_block(T *panel, size_t width, size_t height, size_t block,
                                size_t bottom) {
  const size_t end = std::min(block + panel_columns, width);
  subtract_left<V>(panel, height, 0, block, end, {0, bottom});
  for (size_t first = block; first < end; first += tile_columns) {
    const size_t last = std::min(first + tile_columns, end);
    subtract_left<V>(panel, height, block, first, last, {0, bottom});
    const bool positive = last - first == tile_columns
                              ? factorise_columns<V, tile_columns>(panel, height, first, bottom)
                              : factorise_columns<V, 3>(panel, height, first, bottom);
    if (!positive) return false;
  }
  return true;
}

template <typename V, typename T = typename V::Number>
MVS_INLINE bool factorise_tiles(T *panel, size_t width, size_t height) {
  for (size_t block = 0; block < width; block += panel_columns) {
    if (!factorise_block<V>(panel, width, height, block, height)) return false;
  }
  finish(panel, width, height);
  return true;
}

template <typename V, typename T = typename V::Number>
MVS_INLINE bool factorise_top(T *panel, size_t width, size_t height, size_t block) {
  return factorise_block<V>(panel, width, height, block, rows_below(block, width, height));
}

template <typename V, size_t columns, typename T = typename V::Number>
MVS_INLINE void solve_by_square(T *panel, size_t height, size_t first, Rows rows) {
  Square<columns, T> square;
  square.read(panel, height, first);
  solve_columns_of<V, columns>(square, panel + first * height, height, rows);
}

// Rows below the square of a block of columns.
template <typename V, typename T = typename V::Number>
MVS_INLINE void factorise_below(T *panel, size_t width, size_t height, size_t block, size_t top,
                                size_t bottom) {
  const size_t end = std::min(block + panel_columns, width);
  const Rows rows{top, bottom};
  subtract_left<V>(panel, height, 0, block, end, rows);
  for (size_t first = block; first < end; first += tile_columns) {
    const size_t last = std::min(first + tile_columns, end);
    subtract_left<V>(panel, height, block, first, last, rows);
    if (last - first == tile_columns) {
      solve_by_square<V, tile_columns>(panel, height, first, rows);
    } else {
      solve_by_square<V, 3>(panel, height, first, rows);
    }
  }
}

}  // namespace

template <typename T>
bool factorise_panel(T *panel, size_t width, size_t height) {
  using R = Registers<T>;
  static const auto kernel = simd_kernel<&factorise_tiles<Tall<typename R::Baseline, 2>>,
                                         &factorise_tiles<WideTile<typename R::Avx2>>,
                                         &factorise_tiles<WideTile<typename R::Avx512>>>();
  return kernel(panel, width, height);
}

template <typename T>
bool factorise_square(T *panel, size_t width, size_t height, size_t block) {
  using R = Registers<T>;
  static const auto kernel = simd_kernel<&factorise_top<Tall<typename R::Baseline, 2>>,
                                         &factorise_top<WideTile<typename R::Avx2>>,
                                         &factorise_top<WideTile<typename R::Avx512>>>();
  return kernel(panel, width, height, block);
}

template <typename T>
void factorise_rows(T *panel, size_t width, size_t height, size_t block, size_t first,
                    size_t last) {
  using R = Registers<T>;
  static const auto kernel = simd_kernel<&factorise_below<Tall<typename R::Baseline, 2>>,
                                         &factorise_below<WideTile<typename R::Avx2>>,
                                         &factorise_below<WideTile<typename R::Avx512>>>();
  kernel(panel, width, height, block, first, last);
}

template <typename T>
void finish_panel(T *panel, size_t width, size_t height) {
  finish(panel, width, height);
}

template void finish_panel(double *, size_t, size_t);
template void finish_panel(float *, size_t, size_t);
template bool factorise_panel(double *, size_t, size_t);
template bool factorise_panel(float *, size_t, size_t);
template bool factorise_square(double *, size_t, size_t, size_t);
template bool factorise_square(float *, size_t, size_t, size_t);
template void factorise_rows(double *, size_t, size_t, size_t, size_t, size_t);
template void factorise_rows(float *, size_t, size_t, size_t, size_t, size_t);

}  // namespace mvs::core
