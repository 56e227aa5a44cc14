// Dense kernels of the block factorisation, on panels stored by columns, of doubles or of floats.
//
// Every number of a factor is worked out as c - a1 b1 - a2 b2 ..., one product after the other in
// the order of the columns, whatever the panels, the tiles and the width of the vectors: the bits
// depend on the matrix and the order of its rows alone, not on explicit zeros in its pattern nor on
// the processor. Products and sums are never fused. So it is with solutions, but for the sums of
// solve_backward in floats: their order depends on the panels too.
#pragma once

#include <cstddef>
#include <cstdint>

namespace mvs {

// C[row[i], row[j]] -= sum_k A[i, k] A[j, k] for j < n, j <= i < m, k < depth ascending. A may be
// read up to panel_slack numbers past its end, and entries of C above the diagonal (i < j) may be
// written.
template <typename T>
struct PanelUpdate {
  const T *a;
  size_t a_stride;
  T *c;
  size_t c_stride;
  const uint32_t *row;  // of C, of each row of A; its first n also say which columns
  size_t m, n, depth;
};
inline constexpr size_t panel_slack = 32;

template <typename T>
void update_panel(const PanelUpdate<T> &u);

// Factorises a panel of `width` columns and `height` rows in place: its upper square becomes L,
// with 1 / diagonal on the diagonal, what is below X L^-T. False unless it is positive definite and
// finite. `identity` holds 0 .. height.
template <typename T>
bool factorise_panel(T *panel, size_t width, size_t height, const uint32_t *identity);

// Both work on the rows of a factorised panel, whose width is a multiple of 3: x becomes L^-1 x,
// what is below takes its share. The panel may be read, and x written, up to panel_slack numbers
// past its end.
template <typename T>
void solve_forward(const T *panel, size_t width, size_t height, T *x);
// The first `width` rows of x become L^-T (x - B^T x below).
template <typename T>
void solve_backward(const T *panel, size_t width, size_t height, T *x);

}  // namespace mvs
