// Dense SIMD kernels of the Cholesky factorisation, on panels of doubles or floats stored by
// columns.
//
// Doubles: every number of a factor is c - a1 b1 - a2 b2 ..., one product after the other in the
// order of the columns, for any panels, tiles and registers. The bits depend on the matrix and the
// order of its rows alone, not on explicit zeros in its pattern nor on the processor. The same
// holds for solutions. Floats: the contribution of one panel to another, or to a solution, is
// summed first, so that the bits depend on the panels too, but not on the processor. Products and
// sums are never fused.
#pragma once

#include <cstddef>
#include <cstdint>

namespace mvs::core {

// The height of a panel is a multiple of this; the rest of it is zero.
inline constexpr size_t panel_rows = 16;

// C -= A A^T by blocks of three rows and columns: block (row[i], row[j]) from rows 3 i and 3 j of
// A, for 3 j < n, 3 j <= 3 i < m, and column after column of A. A may be read up to panel_slack
// numbers past its end, and entries of C above the diagonal (i < j) may be written.
template <typename T>
struct PanelUpdate {
  const T *a;
  size_t a_stride;
  T *c;
  size_t c_stride;
  const uint32_t *row;  // of blocks of C, for each three rows of A; the first ones also are columns
  size_t m, n, depth;
};
inline constexpr size_t panel_slack = 32;

template <typename T>
void update_panel(const PanelUpdate<T> &u);

// Factorises a panel of `width` columns, a multiple of 3, and `height` rows in place: its upper
// square becomes L, with 1 / diagonal on the diagonal, the rows X below become X L^-T. For floats
// the 3x3 squares on the diagonal become those of L^-1. Returns false unless the matrix is positive
// definite and finite.
template <typename T>
bool factorise_panel(T *panel, size_t width, size_t height);

// The same in steps for several threads, with the same bits. For each `block` of panel_columns
// columns, in order: the rows of its square first, then parts of the rows below, in any order and
// at the same time; after the last block the end. Returns false as factorise_panel() does.
inline constexpr size_t panel_columns = 48;
template <typename T>
bool factorise_square(T *panel, size_t width, size_t height, size_t block);
// Rows `first` to `last`, multiples of panel_rows, from rows_below() on.
template <typename T>
void factorise_rows(T *panel, size_t width, size_t height, size_t block, size_t first, size_t last);
template <typename T>
void finish_panel(T *panel, size_t width, size_t height);
// The first row below the square of a block.
inline size_t rows_below(size_t block, size_t width, size_t height) {
  const size_t end = block + panel_columns < width ? block + panel_columns : width;
  const size_t row = (end + panel_rows - 1) / panel_rows * panel_rows;
  return row < height ? row : height;
}

// Both work on the rows of a factorised panel, whose width is a multiple of 3. The first rows of x
// become L^-1 x, and their products with the rows below are subtracted from the rest. The panel may
// be read, and x written, up to panel_slack numbers past its end.
template <typename T>
void solve_forward(const T *panel, size_t width, size_t height, T *x);
// The same for the first `rows` rows, of `width` or more, and the rest of it: subtracts from x the
// products of y, the first `width` rows of a solution, with `rows` rows that begin at `row`.
template <typename T>
void solve_forward_to(const T *panel, size_t width, size_t height, size_t rows, T *x);
template <typename T>
void subtract_rows(const T *row, size_t width, size_t height, size_t rows, const T *y, T *x);
// The first `width` rows of x become L^-T (x - B^T x below).
template <typename T>
void solve_backward(const T *panel, size_t width, size_t height, T *x);

}  // namespace mvs::core
