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

// Both work on the rows of a factorised panel, whose width is a multiple of 3. The first rows of x
// become L^-1 x, and their products with the rows below are subtracted from the rest. The panel may
// be read, and x written, up to panel_slack numbers past its end.
template <typename T>
void solve_forward(const T *panel, size_t width, size_t height, T *x);
// The first `width` rows of x become L^-T (x - B^T x below).
template <typename T>
void solve_backward(const T *panel, size_t width, size_t height, T *x);

}  // namespace mvs::core
