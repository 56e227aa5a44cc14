// The kernels: one tile held in registers, the loops over tiles, and the choice of the widest
// vector that the processor has.
#include "base/panel.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/lanes.h"

namespace mvs {
namespace {

constexpr size_t tile_columns = 6;
constexpr size_t block_columns = 48;
// A piece of this size is 96 kB: a part of the second-level cache.
constexpr size_t piece_depth = 128, piece_rows = 96;

// A tile of tile_columns: rows contiguous in C, or gathered into a buffer that is.
template <typename V, typename T = typename V::Number>
MVS_INLINE void subtract_tile(T *c, size_t c_stride, const T *a, const T *b, size_t a_stride,
                              size_t depth) {
  constexpr size_t lanes = V::lanes, vectors = V::vectors;
  typename V::Value sum[vectors][tile_columns], of_a[vectors];
  for (size_t j = 0; j < tile_columns; ++j) {
    for (size_t v = 0; v < vectors; ++v) load<V>(sum[v][j], c + j * c_stride + v * lanes);
  }
  for (size_t k = 0; k < depth; ++k, a += a_stride, b += a_stride) {
    for (size_t v = 0; v < vectors; ++v) load<V>(of_a[v], a + v * lanes);
    for (size_t j = 0; j < tile_columns; ++j) {
      for (size_t v = 0; v < vectors; ++v) sum[v][j] -= of_a[v] * b[j];
    }
  }
  for (size_t j = 0; j < tile_columns; ++j) {
    for (size_t v = 0; v < vectors; ++v) store<V>(c + j * c_stride + v * lanes, sum[v][j]);
  }
}

// A tile whose rows or columns are not all there or not contiguous in C.
template <typename V, typename T = typename V::Number>
MVS_INLINE void subtract_scattered(const PanelUpdate<T> &u, size_t i, size_t j, size_t rows,
                                   size_t columns) {
  T tile[V::height * tile_columns] = {};
  for (size_t q = 0; q < columns; ++q) {
    const T *from = u.c + u.row[j + q] * u.c_stride;
    for (size_t p = 0; p < rows; ++p) tile[q * V::height + p] = from[u.row[i + p]];
  }
  subtract_tile<V>(tile, V::height, u.a + i, u.a + j, u.a_stride, u.depth);
  for (size_t q = 0; q < columns; ++q) {
    T *to = u.c + u.row[j + q] * u.c_stride;
    for (size_t p = 0; p < rows; ++p) to[u.row[i + p]] = tile[q * V::height + p];
  }
}

// Rows first .. last against columns from j on, a piece of the depth at a time.
template <typename V, typename T = typename V::Number>
MVS_INLINE void update_rows(const PanelUpdate<T> &u, size_t first, size_t last, size_t j) {
  constexpr size_t height = V::height;
  const size_t columns = std::min(tile_columns, u.n - j);
  const bool run = columns == tile_columns && u.row[j + columns - 1] - u.row[j] == columns - 1;
  for (size_t i = std::max(first, j); i < last; i += height) {
    const size_t rows = std::min(height, last - i);
    if (run && rows == height && u.row[i + height - 1] - u.row[i] == height - 1) {
      subtract_tile<V>(u.c + u.row[j] * u.c_stride + u.row[i], u.c_stride, u.a + i, u.a + j,
                       u.a_stride, u.depth);
    } else {
      subtract_scattered<V>(u, i, j, rows, columns);
    }
  }
}

// A piece of A that stays in the cache meets all its columns before the next one comes.
template <typename V, typename T = typename V::Number>
MVS_INLINE void update(const PanelUpdate<T> &u) {
  for (size_t k = 0; k < u.depth; k += piece_depth) {
    PanelUpdate<T> piece = u;
    piece.a += k * u.a_stride;
    piece.depth = std::min(piece_depth, u.depth - k);
    for (size_t i = 0; i < u.m; i += piece_rows) {
      const size_t last = std::min(i + piece_rows, u.m);
      for (size_t j = 0; j < std::min(u.n, last); j += tile_columns) {
        update_rows<V>(piece, i, last, j);
      }
    }
  }
}

// Takes from columns first .. last of a panel what the columns left .. first to their left give.
template <typename V, typename T = typename V::Number>
MVS_INLINE void subtract_left(T *panel, size_t height, size_t left, size_t first, size_t last,
                              const uint32_t *identity) {
  if (left == first) return;
  update<V>({panel + left * height + first, height, panel + first * height + first, height,
             identity, height - first, last - first, first - left});
}

// Factorises columns first .. last by themselves, one after the other.
template <typename T>
MVS_INLINE bool factorise_columns(T *panel, size_t height, size_t first, size_t last) {
  for (size_t j = first; j < last; ++j) {
    T *column = panel + j * height;
    for (size_t k = first; k < j; ++k) {
      const T *earlier = panel + k * height, factor = earlier[j];
      for (size_t i = j; i < height; ++i) column[i] -= earlier[i] * factor;
    }
    const T pivot = column[j];
    if (!(pivot > 0) || !std::isfinite(pivot)) return false;
    const T inverse = 1 / std::sqrt(pivot);
    column[j] = inverse;
    for (size_t i = j + 1; i < height; ++i) column[i] *= inverse;
  }
  return true;
}

// Blocks of columns, and tiles of columns in them.
template <typename V, typename T = typename V::Number>
MVS_INLINE bool factorise(T *panel, size_t width, size_t height, const uint32_t *identity) {
  for (size_t block = 0; block < width; block += block_columns) {
    const size_t end = std::min(block + block_columns, width);
    subtract_left<V>(panel, height, 0, block, end, identity);
    for (size_t first = block; first < end; first += tile_columns) {
      const size_t last = std::min(first + tile_columns, end);
      subtract_left<V>(panel, height, block, first, last, identity);
      if (!factorise_columns(panel, height, first, last)) return false;
    }
  }
  return true;
}

template <typename T>
struct Kernels {
  void (*update)(const PanelUpdate<T> &);
  bool (*factorise)(T *, size_t, size_t, const uint32_t *);
};

// The kernels compiled for a target with V its vectors. Attributes cannot be in parentheses.
// NOLINTBEGIN(bugprone-macro-parentheses)
#define MVS_KERNELS(Name, ATTRIBUTE)                                                      \
  template <typename V>                                                                   \
  struct Name {                                                                           \
    using T = typename V::Number;                                                         \
    ATTRIBUTE static void update(const PanelUpdate<T> &u) { mvs::update<V>(u); }          \
    ATTRIBUTE static bool factorise(T *p, size_t w, size_t h, const uint32_t *identity) { \
      return mvs::factorise<V>(p, w, h, identity);                                        \
    }                                                                                     \
    static Kernels<T> all() { return {&update, &factorise}; }                             \
  }

// NOLINTEND(bugprone-macro-parentheses)

MVS_KERNELS(Plain, );
#if defined(__x86_64__) && defined(__GNUC__)
MVS_KERNELS(Wider, [[gnu::target("avx2")]]);
MVS_KERNELS(Widest, [[gnu::target("avx512f")]]);
#endif

// A tile of floats has as many rows as one of doubles: panels of small valves are not high.
template <typename T>
Kernels<T> choose() {
  constexpr size_t sse = 16 / sizeof(T);
  constexpr bool narrow = sizeof(T) == 4;
#if defined(__x86_64__) && defined(__GNUC__)
  if (__builtin_cpu_supports("avx512f")) return Widest<Wide<T, 4 * sse, narrow ? 1 : 2>>::all();
  if (__builtin_cpu_supports("avx2")) return Wider<Wide<T, 2 * sse, narrow ? 1 : 2>>::all();
#endif
  return Plain<Wide<T, sse, 2>>::all();
}

template <typename T>
const Kernels<T> &kernels() {
  static const Kernels<T> chosen = choose<T>();
  return chosen;
}

}  // namespace

template <typename T>
void update_panel(const PanelUpdate<T> &u) {
  kernels<T>().update(u);
}

template <typename T>
bool factorise_panel(T *panel, size_t width, size_t height, const uint32_t *identity) {
  return kernels<T>().factorise(panel, width, height, identity);
}

template void update_panel(const PanelUpdate<double> &);
template void update_panel(const PanelUpdate<float> &);
template bool factorise_panel(double *, size_t, size_t, const uint32_t *);
template bool factorise_panel(float *, size_t, size_t, const uint32_t *);

}  // namespace mvs
