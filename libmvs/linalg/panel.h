// Dense kernels of the block factorisation, on panels stored by columns, of doubles or of floats.
//
// Of doubles every number of a factor is worked out as c - a1 b1 - a2 b2 ..., one product after the
// other in the order of the columns, whatever the panels, the tiles and the width of the vectors:
// the bits depend on the matrix and the order of its rows alone, not on explicit zeros in its
// pattern nor on the processor. So it is with solutions. Of floats what one panel gives to another,
// and to a solution, is summed first, so that bits depend on the panels too, but on no processor.
// Products and sums are never fused.
#pragma once

#include <cstddef>
#include <cstdint>

namespace mvs::core {

// The height of a panel is a multiple of this: what its rows do not fill is zero.
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
  const uint32_t *row;  // of blocks of C, of each three rows of A; the first also say which columns
  size_t m, n, depth;
};
inline constexpr size_t panel_slack = 32;

template <typename T>
void update_panel(const PanelUpdate<T> &u);

// Factorises a panel of `width` columns, a multiple of 3, and `height` rows in place: its upper
// square becomes L, with 1 / diagonal on the diagonal, what is below X L^-T. Of floats the squares
// of three columns on the diagonal become those of L^-1. False unless it is positive definite and
// finite.
template <typename T>
bool factorise_panel(T *panel, size_t width, size_t height);

// Both work on the rows of a factorised panel, whose width is a multiple of 3: x becomes L^-1 x,
// what is below takes its share. The panel may be read, and x written, up to panel_slack numbers
// past its end.
template <typename T>
void solve_forward(const T *panel, size_t width, size_t height, T *x);
// The first `width` rows of x become L^-T (x - B^T x below).
template <typename T>
void solve_backward(const T *panel, size_t width, size_t height, T *x);

}  // namespace mvs::core
