// One tile of C -= A B^T in registers, for panel_update.cpp and panel_factor.cpp.
#pragma once

#include <cstddef>

#include "base/simd.h"

namespace mvs::core {

inline constexpr size_t tile_columns = 6;
// A slab of this size is 96 kB, which fits the second-level cache.
inline constexpr size_t slab_depth = 128, slab_rows = 96;

// A tile is `vectors` registers high.
template <typename V, size_t vectors_in>
struct Tall : V {
  static constexpr size_t vectors = vectors_in, height = V::width * vectors;
};

// A tile of some columns: C -= A B^T, of B the rows that the columns of C have.
template <typename V, size_t columns, bool from_zero = false, typename T = typename V::Number>
MVS_INLINE void subtract_tile(T *c, size_t c_stride, const T *a, const T *b, size_t a_stride,
                              size_t depth) {
  constexpr size_t width = V::width, vectors = V::vectors;
  typename V::Value sum[vectors][columns], of_a[vectors];
  for (size_t j = 0; j < columns; ++j) {
    for (size_t v = 0; v < vectors; ++v) {
      if constexpr (from_zero) {
        sum[v][j] = typename V::Value{};
      } else {
        load<V>(sum[v][j], c + j * c_stride + v * width);
      }
    }
  }
  for (size_t k = 0; k < depth; ++k, a += a_stride, b += a_stride) {
    for (size_t v = 0; v < vectors; ++v) load<V>(of_a[v], a + v * width);
    for (size_t j = 0; j < columns; ++j) {
      for (size_t v = 0; v < vectors; ++v) sum[v][j] -= of_a[v] * b[j];
    }
  }
  for (size_t j = 0; j < columns; ++j) {
    for (size_t v = 0; v < vectors; ++v) store<V>(c + j * c_stride + v * width, sum[v][j]);
  }
}

// A tile of floats has as many rows as one of doubles: panels of small valves are not high.
template <typename V>
using WideTile = Tall<V, sizeof(typename V::Number) == 4 ? 1 : 2>;

}  // namespace mvs::core
