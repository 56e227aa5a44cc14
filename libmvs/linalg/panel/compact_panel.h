// Factorised panels in 16 bits, for solutions as a preconditioner. A solution with a large factor
// waits for memory: here it reads half as much, in the order of storage.
//
// Each column is stored as integers times a scale, its largest number below the diagonal block over
// 32767: an error of at most 1.5e-5 of that number. Diagonal blocks of solve_columns columns become
// their inverses, in floats, by columns and by rows, both padded to 16 numbers. The rows below such
// a block come in tiles of 16 rows, column after column, two rows of a column (r and r + 8) in each
// word. No bit depends on the processor.
#pragma once

#include <cstddef>
#include <cstdint>

namespace mvs::core {

// The numbers that each column of a panel has in `inverse`.
inline constexpr size_t inverse_numbers = 32;

struct CompactPanel {
  float *inverse;  // of the diagonal blocks, block after block
  int32_t *tiles;
  float *scale;  // of each column
  size_t width, height;
};

// Words of the tiles of a panel.
size_t compact_size(size_t width, size_t height);
// Sets the compact form of a panel that factorise_panel() has left.
void compress_panel(const float *panel, const CompactPanel &to);
// These do what solve_forward() and solve_backward() of panel.h do, with the compact form.
void solve_forward(const CompactPanel &panel, float *x);
void solve_backward(const CompactPanel &panel, float *x);

}  // namespace mvs::core
