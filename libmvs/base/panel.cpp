// The kernels: one tile held in registers, the loops over tiles, and the choice of the widest
// vector that the processor has.
#include "base/panel.h"

#include <algorithm>
#include <cmath>

namespace mvs {
namespace {

constexpr size_t tile_columns = 6;
constexpr size_t block_columns = 48;
// A piece of this size is 96 kB: a part of the second-level cache.
constexpr size_t piece_depth = 128, piece_rows = 96;

// Vectors in registers, and as they lie in memory: anywhere.
#if defined(__GNUC__)
#define MVS_INLINE [[gnu::always_inline]] inline
template <size_t count>
struct Wide {
  static constexpr size_t lanes = count;
  typedef double Value __attribute__((vector_size(8 * count)));
  typedef double Memory __attribute__((vector_size(8 * count), aligned(8), may_alias));
};
#else
#define MVS_INLINE inline
template <size_t>
struct Wide {
  static constexpr size_t lanes = 1;
  typedef double Value;
  typedef double Memory;
};
#endif

// A tile of 2 vectors by tile_columns: rows contiguous in C, or gathered into a buffer that is.
template <typename V>
MVS_INLINE void subtract_tile(double *c, size_t c_stride, const double *a, const double *b,
                              size_t a_stride, size_t depth) {
  constexpr size_t lanes = V::lanes;
  using Value = typename V::Value;
  using Memory = typename V::Memory;
  Value sum[2][tile_columns];
  for (size_t j = 0; j < tile_columns; ++j) {
    sum[0][j] = *reinterpret_cast<const Memory *>(c + j * c_stride);
    sum[1][j] = *reinterpret_cast<const Memory *>(c + j * c_stride + lanes);
  }
  for (size_t k = 0; k < depth; ++k, a += a_stride, b += a_stride) {
    const Value a0 = *reinterpret_cast<const Memory *>(a),
                a1 = *reinterpret_cast<const Memory *>(a + lanes);
    for (size_t j = 0; j < tile_columns; ++j) {
      sum[0][j] -= a0 * b[j];
      sum[1][j] -= a1 * b[j];
    }
  }
  for (size_t j = 0; j < tile_columns; ++j) {
    *reinterpret_cast<Memory *>(c + j * c_stride) = sum[0][j];
    *reinterpret_cast<Memory *>(c + j * c_stride + lanes) = sum[1][j];
  }
}

// A tile whose rows or columns are not all there or not contiguous in C.
template <typename V>
MVS_INLINE void subtract_scattered(const PanelUpdate &u, size_t i, size_t j, size_t rows,
                                   size_t columns) {
  constexpr size_t height = 2 * V::lanes;
  double tile[height * tile_columns] = {};
  for (size_t q = 0; q < columns; ++q) {
    const double *from = u.c + u.row[j + q] * u.c_stride;
    for (size_t p = 0; p < rows; ++p) tile[q * height + p] = from[u.row[i + p]];
  }
  subtract_tile<V>(tile, height, u.a + i, u.a + j, u.a_stride, u.depth);
  for (size_t q = 0; q < columns; ++q) {
    double *to = u.c + u.row[j + q] * u.c_stride;
    for (size_t p = 0; p < rows; ++p) to[u.row[i + p]] = tile[q * height + p];
  }
}

// Rows first .. last against columns from j on, a piece of the depth at a time.
template <typename V>
MVS_INLINE void update_rows(const PanelUpdate &u, size_t first, size_t last, size_t j) {
  constexpr size_t height = 2 * V::lanes;
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
template <typename V>
MVS_INLINE void update(const PanelUpdate &u) {
  for (size_t k = 0; k < u.depth; k += piece_depth) {
    PanelUpdate piece = u;
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
template <typename V>
MVS_INLINE void subtract_left(double *panel, size_t height, size_t left, size_t first, size_t last,
                              const uint32_t *identity) {
  if (left == first) return;
  update<V>({panel + left * height + first, height, panel + first * height + first, height,
             identity, height - first, last - first, first - left});
}

// Factorises columns first .. last by themselves, one after the other.
MVS_INLINE bool factorise_columns(double *panel, size_t height, size_t first, size_t last) {
  for (size_t j = first; j < last; ++j) {
    double *column = panel + j * height;
    for (size_t k = first; k < j; ++k) {
      const double *earlier = panel + k * height, factor = earlier[j];
      for (size_t i = j; i < height; ++i) column[i] -= earlier[i] * factor;
    }
    const double pivot = column[j];
    if (!(pivot > 0) || !std::isfinite(pivot)) return false;
    const double inverse = 1 / std::sqrt(pivot);
    column[j] = inverse;
    for (size_t i = j + 1; i < height; ++i) column[i] *= inverse;
  }
  return true;
}

// Blocks of columns, and tiles of columns in them.
template <typename V>
MVS_INLINE bool factorise(double *panel, size_t width, size_t height, const uint32_t *identity) {
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

struct Kernels {
  void (*update)(const PanelUpdate &);
  bool (*factorise)(double *, size_t, size_t, const uint32_t *);
};

Kernels choose() {
#if defined(__x86_64__) && defined(__GNUC__)
  struct Widest {
    [[gnu::target("avx512f")]] static void update(const PanelUpdate &u) { mvs::update<Wide<8>>(u); }
    [[gnu::target("avx512f")]] static bool factorise(double *panel, size_t width, size_t height,
                                                     const uint32_t *identity) {
      return mvs::factorise<Wide<8>>(panel, width, height, identity);
    }
  };
  struct Wider {
    [[gnu::target("avx2")]] static void update(const PanelUpdate &u) { mvs::update<Wide<4>>(u); }
    [[gnu::target("avx2")]] static bool factorise(double *panel, size_t width, size_t height,
                                                  const uint32_t *identity) {
      return mvs::factorise<Wide<4>>(panel, width, height, identity);
    }
  };
  if (__builtin_cpu_supports("avx512f")) return {&Widest::update, &Widest::factorise};
  if (__builtin_cpu_supports("avx2")) return {&Wider::update, &Wider::factorise};
#endif
  struct Plain {
    static void update(const PanelUpdate &u) { mvs::update<Wide<2>>(u); }
    static bool factorise(double *panel, size_t width, size_t height, const uint32_t *identity) {
      return mvs::factorise<Wide<2>>(panel, width, height, identity);
    }
  };
  return {&Plain::update, &Plain::factorise};
}

const Kernels &kernels() {
  static const Kernels chosen = choose();
  return chosen;
}

}  // namespace

void update_panel(const PanelUpdate &u) {
  kernels().update(u);
}

bool factorise_panel(double *panel, size_t width, size_t height, const uint32_t *identity) {
  return kernels().factorise(panel, width, height, identity);
}

void solve_forward(const double *panel, size_t width, size_t height, double *x) {
  for (size_t j = 0; j < width; ++j, panel += height) {
    const double y = x[j] *= panel[j];
    for (size_t i = j + 1; i < height; ++i) x[i] -= panel[i] * y;
  }
}

// Three columns at a time, as many as a block has: their sums do not wait for each other.
void solve_backward(const double *panel, size_t width, size_t height, double *x) {
  for (size_t j = width; j > 0; j -= 3) {
    const double *a = panel + (j - 3) * height, *b = a + height, *c = b + height;
    double x0 = x[j - 3], x1 = x[j - 2], x2 = x[j - 1];
    for (size_t i = height; i-- > j;) {
      x0 -= a[i] * x[i];
      x1 -= b[i] * x[i];
      x2 -= c[i] * x[i];
    }
    x2 *= c[j - 1];
    x1 = (x1 - b[j - 1] * x2) * b[j - 2];
    x0 = (x0 - a[j - 1] * x2 - a[j - 2] * x1) * a[j - 3];
    x[j - 3] = x0;
    x[j - 2] = x1;
    x[j - 1] = x2;
  }
}

}  // namespace mvs
