// Kernels on tiles: integers become floats in registers, and scales multiply the numbers of a
// solution, of which there are few.
#include "linalg/panel/compact_panel.h"

#include <algorithm>
#include <array>
#include <type_traits>

#include "base/bit_cast.h"
#include "base/simd.h"
#include "linalg/panel/panel_block.h"

namespace mvs::core {
namespace {

constexpr size_t batch = 8, tile_rows = 2 * batch;
constexpr float most = 32767;

size_t tile_count(size_t last, size_t height) {
  return (height - last + tile_rows - 1) / tile_rows;
}

// Calls use(first, last, words) for the columns first .. last of each diagonal block, in order.
// `words` are those of the tiles before.
template <typename Use>
MVS_INLINE void for_blocks(size_t width, size_t height, const Use &use) {
  size_t words = 0;
  for (size_t first = 0; first < width; first += solve_columns) {
    const size_t last = std::min(first + solve_columns, width);
    use(first, last, words);
    words += tile_count(last, height) * (last - first) * batch;
  }
}

// The 16 numbers of a column of a tile: of the lower and the upper half of its words.
struct Pair {
  Float8::Value low, high;
};

#if defined(__GNUC__)
typedef int32_t Words __attribute__((vector_size(4 * batch), aligned(4), may_alias));

MVS_INLINE void unpack(const int32_t *words, Pair &to) {
  const Float8::Mask both = *reinterpret_cast<const Words *>(words);
  to.low = __builtin_convertvector((both << 16) >> 16, Float8::Value);
  to.high = __builtin_convertvector(both >> 16, Float8::Value);
}

// y = A x for a matrix of `columns` columns of 16 numbers.
MVS_INLINE void multiply(const float *a, size_t columns, const float *x, float *y) {
  Pair sum = {}, of_a;
  for (size_t k = 0; k < columns; ++k, a += tile_rows) {
    load<Float8>(of_a.low, a);
    load<Float8>(of_a.high, a + batch);
    sum.low += of_a.low * x[k];
    sum.high += of_a.high * x[k];
  }
  store<Float8>(y, sum.low);
  store<Float8>(y + batch, sum.high);
}

// x -= a by for the rows of a tile.
template <size_t columns>
MVS_INLINE void take_tile(const int32_t *words, const float *by, float *x) {
  Pair sum, a;
  load<Float8>(sum.low, x);
  load<Float8>(sum.high, x + batch);
  for (size_t k = 0; k < columns; ++k, words += batch) {
    unpack(words, a);
    sum.low -= a.low * by[k];
    sum.high -= a.high * by[k];
  }
  store<Float8>(x, sum.low);
  store<Float8>(x + batch, sum.high);
}

// to[k] -= scale[k] sum_i a[i, k] x[i] over all tiles, in eight sums for each column.
template <size_t columns>
MVS_INLINE void take_sums(const int32_t *words, size_t tiles, const float *x, const float *scale,
                          float *to) {
  std::array<Float8::Value, columns> sum = {};
  Pair of_x, a;
  for (size_t tile = 0; tile < tiles; ++tile, x += tile_rows) {
    load<Float8>(of_x.low, x);
    load<Float8>(of_x.high, x + batch);
    for (size_t k = 0; k < columns; ++k, words += batch) {
      unpack(words, a);
      sum[k] += a.low * of_x.low;
      sum[k] += a.high * of_x.high;
    }
  }
  for (size_t k = 0; k < columns; ++k) to[k] -= scale[k] * sum_of(sum[k]);
}
#else
// The same without vectors.
MVS_INLINE void multiply(const float *a, size_t columns, const float *x, float *y) {
  std::fill_n(y, tile_rows, 0.0f);
  for (size_t k = 0; k < columns; ++k, a += tile_rows) {
    for (size_t r = 0; r < tile_rows; ++r) y[r] += a[r] * x[k];
  }
}

MVS_INLINE float low_of(int32_t word) {
  return static_cast<float>(static_cast<int16_t>(word & 0xffff));
}
MVS_INLINE float high_of(int32_t word) {
  return static_cast<float>(static_cast<int16_t>(word >> 16));
}

template <size_t columns>
MVS_INLINE void take_tile(const int32_t *words, const float *by, float *x) {
  for (size_t k = 0; k < columns; ++k, words += batch) {
    for (size_t r = 0; r < batch; ++r) {
      x[r] -= low_of(words[r]) * by[k];
      x[batch + r] -= high_of(words[r]) * by[k];
    }
  }
}

template <size_t columns>
MVS_INLINE void take_sums(const int32_t *words, size_t tiles, const float *x, const float *scale,
                          float *to) {
  std::array<std::array<float, batch>, columns> sum = {};
  for (size_t tile = 0; tile < tiles; ++tile, x += tile_rows) {
    for (size_t k = 0; k < columns; ++k, words += batch) {
      for (size_t r = 0; r < batch; ++r) {
        sum[k][r] += low_of(words[r]) * x[r];
        sum[k][r] += high_of(words[r]) * x[batch + r];
      }
    }
  }
  for (size_t k = 0; k < columns; ++k) {
    const auto &s = sum[k];
    to[k] -= scale[k] * (((s[0] + s[4]) + (s[2] + s[6])) + ((s[1] + s[5]) + (s[3] + s[7])));
  }
}
#endif

template <size_t columns>
MVS_INLINE void take_tiles(const int32_t *words, size_t tiles, const float *by, float *x) {
  for (size_t tile = 0; tile < tiles; ++tile, x += tile_rows, words += columns * batch) {
    take_tile<columns>(words, by, x);
  }
}

// Calls use() with the number of columns of a block as a constant.
template <typename Use>
MVS_INLINE void for_columns(size_t columns, const Use &use) {
  switch (columns) {
    case 3:
      return use(std::integral_constant<size_t, 3>());
    case 6:
      return use(std::integral_constant<size_t, 6>());
    case 9:
      return use(std::integral_constant<size_t, 9>());
    default:
      return use(std::integral_constant<size_t, solve_columns>());
  }
}

MVS_INLINE void forward_columns(const CompactPanel &p, float *x) {
  std::array<float, tile_rows> y;
  for_blocks(p.width, p.height, [&](size_t first, size_t last, size_t words) {
    const size_t columns = last - first, tiles = tile_count(last, p.height);
    const int32_t *from = p.tiles + words;
    multiply(p.inverse + inverse_numbers * first, columns, x + first, y.data());
    std::copy_n(y.data(), columns, x + first);
    for (size_t k = 0; k < columns; ++k) y[k] *= p.scale[first + k];
    for_columns(columns,
                [&](auto constant) { take_tiles<constant>(from, tiles, y.data(), x + last); });
  });
}

MVS_INLINE void backward_columns(const CompactPanel &p, float *x) {
  std::array<float, tile_rows> y;
  const int32_t *from = p.tiles;
  for_blocks(p.width, p.height, [&](size_t first, size_t last, size_t) {
    from += tile_count(last, p.height) * (last - first) * batch;
  });
  for (size_t last = p.width; last > 0;) {
    const size_t first = (last - 1) / solve_columns * solve_columns;
    const size_t columns = last - first, tiles = tile_count(last, p.height);
    from -= tiles * columns * batch;
    const float *scale = p.scale + first;
    for_columns(columns, [&](auto constant) {
      take_sums<constant>(from, tiles, x + last, scale, x + first);
    });
    multiply(p.inverse + inverse_numbers * first + tile_rows * columns, columns, x + first,
             y.data());
    std::copy_n(y.data(), columns, x + first);
    last = first;
  }
}

// Rounds to the nearest integer, halves away from zero.
MVS_INLINE int32_t rounded(float v) {
  return static_cast<int32_t>(v + (v < 0 ? -0.5f : 0.5f));
}

MVS_INLINE float scale_of(const float *column, size_t first, size_t height) {
  int32_t largest = 0;  // the bits of absolute values ascend with them
  for (size_t i = first; i < height; ++i) {
    largest = std::max(largest, bit_cast<int32_t>(column[i]) & INT32_MAX);
  }
  return bit_cast<float>(largest) / most;
}

// Sets the inverse of a diagonal block, by columns and by rows.
MVS_INLINE void invert(const float *panel, size_t height, size_t columns, float *inverse) {
  float *by_rows = inverse + tile_rows * columns;
  std::fill_n(inverse, inverse_numbers * columns, 0.0f);
  for (size_t k = 0; k < columns; ++k) {
    float *column = inverse + tile_rows * k;
    column[k] = 1;
    forward_block(panel, height, 0, columns, column);
    for (size_t r = k; r < columns; ++r) by_rows[tile_rows * r + k] = column[r];
  }
}

MVS_INLINE void compress(const float *panel, const CompactPanel &p) {
  const size_t height = p.height;
  float *scale = p.scale;
  for_blocks(p.width, height, [&](size_t first, size_t last, size_t words) {
    invert(panel + first * height + first, height, last - first,
           p.inverse + inverse_numbers * first);
    for (size_t j = first; j < last; ++j) {
      const float *from = panel + j * height;
      scale[j] = scale_of(from, last, height);
      // a subnormal scale is zero with FlushDenormals
      const float by = scale[j] > 0 ? 1 / scale[j] : 0;
      const auto number = [&](size_t i) { return i < height ? rounded(from[i] * by) : 0; };
      int32_t *to = p.tiles + words + (j - first) * batch;
      for (size_t i = last; i < height; i += tile_rows, to += (last - first) * batch) {
        for (size_t r = 0; r < batch; ++r) {
          to[r] = static_cast<int32_t>((static_cast<uint32_t>(number(i + batch + r)) << 16) |
                                       (static_cast<uint32_t>(number(i + r)) & 0xffffu));
        }
      }
    }
  });
}

}  // namespace

size_t compact_size(size_t width, size_t height) {
  size_t words = 0;
  for_blocks(width, height, [&](size_t first, size_t last, size_t before) {
    words = before + tile_count(last, height) * (last - first) * batch;
  });
  return words;
}

void compress_panel(const float *panel, const CompactPanel &to) {
  static const auto kernel = simd_kernel<&compress>();
  kernel(panel, to);
}

void solve_forward(const CompactPanel &panel, float *x) {
  static const auto kernel = simd_kernel<&forward_columns>();
  kernel(panel, x);
}

void solve_backward(const CompactPanel &panel, float *x) {
  static const auto kernel = simd_kernel<&backward_columns>();
  kernel(panel, x);
}

}  // namespace mvs::core
