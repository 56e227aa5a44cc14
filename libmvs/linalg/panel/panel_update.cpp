// Contribution of one panel to another: cache-blocked loops over tiles, whose blocks are gathered
// from the rows of C and put back.
#include <algorithm>
#include <type_traits>

#include "base/simd.h"
#include "linalg/panel/panel.h"
#include "linalg/panel/panel_tile.h"

namespace mvs::core {
namespace {

// Some columns of C from row i on, gathered by blocks.
template <size_t columns, typename T>
struct Tile {
  T value[columns * slab_rows];

  // Calls visit(block of C, block here) for each of `rows` rows.
  template <typename Visit>
  MVS_INLINE void for_each(const PanelUpdate<T> &u, size_t i, size_t j, size_t rows,
                           const Visit &visit) {
    for (size_t q = 0; q < columns; ++q) {
      T *column = u.c + (3 * u.row[(j + q) / 3] + q % 3) * u.c_stride;
      for (size_t p = 0; p < rows; p += 3) {
        visit(column + 3 * u.row[(i + p) / 3], value + q * slab_rows + p);
      }
    }
  }
};

// Columns of C from j on.
template <typename V, size_t columns, typename T = typename V::Number>
MVS_INLINE void update_columns(const PanelUpdate<T> &u, size_t j) {
  Tile<columns, T> tile;
  constexpr bool exact = std::is_same_v<T, double>;
  for (size_t i = j; i < u.m; i += slab_rows) {
    const size_t rows = std::min(slab_rows, u.m - i);
    if (exact) {
      tile.for_each(u, i, j, rows, [](const T *c, T *here) {
        here[0] = c[0];
        here[1] = c[1];
        here[2] = c[2];
      });
    }
    for (size_t p = 0; p < rows; p += V::height) {
      subtract_tile<V, columns, !exact>(tile.value + p, slab_rows, u.a + i + p, u.a + j, u.a_stride,
                                        u.depth);
    }
    tile.for_each(u, i, j, rows, [](T *c, const T *here) {
      c[0] = exact ? here[0] : c[0] + here[0];
      c[1] = exact ? here[1] : c[1] + here[1];
      c[2] = exact ? here[2] : c[2] + here[2];
    });
  }
}

// One slab of the depth at a time, so that A stays in the cache while its columns pass.
template <typename V, typename T = typename V::Number>
MVS_INLINE void update_tiles(const PanelUpdate<T> &u) {
  for (size_t k = 0; k < u.depth; k += slab_depth) {
    PanelUpdate<T> slab = u;
    slab.a += k * u.a_stride;
    slab.depth = std::min(slab_depth, u.depth - k);
    size_t j = 0;
    for (; j + tile_columns <= u.n; j += tile_columns) update_columns<V, tile_columns>(slab, j);
    if (j < u.n) update_columns<V, 3>(slab, j);
  }
}

}  // namespace

template <typename T>
void update_panel(const PanelUpdate<T> &u) {
  using R = Registers<T>;
  static const auto kernel = simd_kernel<&update_tiles<Tall<typename R::Baseline, 2>>,
                                         &update_tiles<WideTile<typename R::Avx2>>,
                                         &update_tiles<WideTile<typename R::Avx512>>>();
  kernel(u);
}

template void update_panel(const PanelUpdate<double> &);
template void update_panel(const PanelUpdate<float> &);

}  // namespace mvs::core
