// A sparse Cholesky factorisation on 3x3 blocks, written for meshes of a few hundred to a few ten
// thousand nodes: a third of the index work of a scalar one, and dense arithmetic inside.
//
// Left-looking: column j of L gathers what every earlier column k with L_jk != 0 contributes
// (George & Liu, Computer Solution of Large Sparse Positive Definite Systems, 1981; Davis, Direct
// Methods for Sparse Linear Systems, 2006, section 4). The order of all sums is fixed by the
// pattern.
#include "base/factor_block.h"

#include <cmath>

namespace mvs {
namespace {

// A block is kept by columns of four, the fourth row zero, so that a column fills a vector
// register.
constexpr size_t block_size = 12;

// C -= A B^T.
[[gnu::always_inline]] inline void subtract_product(double *c, const double *a, const double *b) {
  for (int col = 0; col < 3; ++col) {
    const double b0 = b[col], b1 = b[col + 4], b2 = b[col + 8];
    for (int row = 0; row < 4; ++row) {
      c[4 * col + row] -= a[row] * b0 + a[row + 4] * b1 + a[row + 8] * b2;
    }
  }
}

// Takes from the gathered column what one earlier column contributes: blocks first .. last of it.
[[gnu::always_inline]] inline void subtract_column(double *gather, const double *value,
                                                   const uint32_t *row, size_t first, size_t last) {
  const double *mine = value + block_size * first;
  for (size_t p = first; p < last; ++p) {
    subtract_product(gather + block_size * row[p], value + block_size * p, mine);
  }
}

using SubtractColumn = void (*)(double *, const double *, const uint32_t *, size_t, size_t);

void subtract_column_plain(double *gather, const double *value, const uint32_t *row, size_t first,
                           size_t last) {
  subtract_column(gather, value, row, first, last);
}

// The same operations in the same order, four at a time where the processor can: the same bits,
// because products and sums are never fused.
SubtractColumn choose_subtract_column() {
#if defined(__x86_64__) && defined(__GNUC__)
  struct Wide {
    [[gnu::target("avx2")]] static void run(double *gather, const double *value,
                                            const uint32_t *row, size_t first, size_t last) {
      subtract_column(gather, value, row, first, last);
    }
  };
  if (__builtin_cpu_supports("avx2")) return &Wide::run;
#endif
  return &subtract_column_plain;
}

// The lower Cholesky factor of a 3x3 block with the inverses of its diagonal beside it.
struct Small {
  double l10, l20, l21;  // below the diagonal
  double i0, i1, i2;     // 1 / diagonal
};

// False unless the block is positive definite and finite.
inline bool cholesky(const double *a, Small &s) {
  const double d0 = a[0];
  if (!(d0 > 0) || !std::isfinite(d0)) return false;
  const double l00 = std::sqrt(d0);
  s.i0 = 1 / l00;
  s.l10 = a[1] * s.i0;
  s.l20 = a[2] * s.i0;
  const double d1 = a[5] - s.l10 * s.l10;
  if (!(d1 > 0) || !std::isfinite(d1)) return false;
  s.i1 = 1 / std::sqrt(d1);
  s.l21 = (a[6] - s.l20 * s.l10) * s.i1;
  const double d2 = a[10] - s.l20 * s.l20 - s.l21 * s.l21;
  if (!(d2 > 0) || !std::isfinite(d2)) return false;
  s.i2 = 1 / std::sqrt(d2);
  return true;
}

// B <- B L^-T, by columns of B.
inline void divide(double *b, const Small &s) {
  for (int row = 0; row < 3; ++row) {
    const double x0 = b[row] * s.i0;
    const double x1 = (b[row + 4] - x0 * s.l10) * s.i1;
    b[row] = x0;
    b[row + 4] = x1;
    b[row + 8] = (b[row + 8] - x0 * s.l20 - x1 * s.l21) * s.i2;
  }
}

class BlockFactor final : public Factor {
 public:
  void analyse(const BlockMatrix &matrix) override;
  bool factorise(const BlockMatrix &matrix) override;
  void solve(std::vector<Vec3> &b) override;

 private:
  double *block(size_t slot) { return value_.data() + block_size * slot; }
  double *gathered(uint32_t row) { return gather_.data() + block_size * row; }
  void gather(const BlockMatrix &matrix, uint32_t j);
  void link(uint32_t column, size_t slot);

  SubtractColumn subtract_ = choose_subtract_column();
  uint32_t n_ = 0;
  std::vector<size_t> start_;  // of each column's blocks below the diagonal
  std::vector<uint32_t> row_;
  std::vector<double> value_;  // block_size a block
  std::vector<Small> diagonal_;
  std::vector<double> gather_;         // column at hand, 9 a row
  std::vector<uint32_t> next_, head_;  // columns waiting to contribute to a row, linked
  std::vector<size_t> at_;             // how far each column has got
};

// The pattern of column j: its own rows, and those of the columns whose first row below is j.
void BlockFactor::analyse(const BlockMatrix &matrix) {
  n_ = matrix.size();
  start_.assign(n_ + 1, 0);
  row_.clear();
  std::vector<std::vector<uint32_t>> children(n_);
  std::vector<uint32_t> mark(n_, none);
  std::vector<uint32_t> column;
  for (uint32_t j = 0; j < n_; ++j) {
    column.clear();
    mark[j] = j;
    auto take = [&](uint32_t r) {
      if (r > j && mark[r] != j) {
        mark[r] = j;
        column.push_back(r);
      }
    };
    for (uint32_t k = matrix.start[j]; k < matrix.start[j + 1]; ++k) take(matrix.row[k]);
    for (const uint32_t child : children[j]) {
      for (size_t k = start_[child]; k < start_[child + 1]; ++k) take(row_[k]);
    }
    std::sort(column.begin(), column.end());
    row_.insert(row_.end(), column.begin(), column.end());
    start_[j + 1] = row_.size();
    if (!column.empty()) children[column[0]].push_back(j);
  }
  value_.resize(block_size * row_.size());
  diagonal_.resize(n_);
  gather_.assign(block_size * n_, 0);
  at_.resize(n_);
  next_.resize(n_);
}

// The column of the matrix, in the rows of the factor's column.
void BlockFactor::gather(const BlockMatrix &matrix, uint32_t j) {
  for (size_t k = start_[j]; k < start_[j + 1]; ++k) {
    std::fill_n(gathered(row_[k]), block_size, 0.0);
  }
  for (uint32_t k = matrix.start[j]; k < matrix.start[j + 1]; ++k) {
    const double *from = matrix.value[k].data();
    double *to = gathered(matrix.row[k]);
    for (int c = 0; c < 3; ++c) std::copy(from + 3 * c, from + 3 * c + 3, to + 4 * c);
  }
}

// Lets a column wait for the row of its block `slot`.
void BlockFactor::link(uint32_t column, size_t slot) {
  at_[column] = slot;
  if (slot == start_[column + 1]) return;
  next_[column] = head_[row_[slot]];
  head_[row_[slot]] = column;
}

bool BlockFactor::factorise(const BlockMatrix &matrix) {
  head_.assign(n_, none);
  for (uint32_t j = 0; j < n_; ++j) {
    gather(matrix, j);
    for (uint32_t k = head_[j]; k != none;) {
      const uint32_t following = next_[k];
      subtract_(gather_.data(), value_.data(), row_.data(), at_[k], start_[k + 1]);
      link(k, at_[k] + 1);
      k = following;
    }
    if (!cholesky(gathered(j), diagonal_[j])) return false;
    for (size_t k = start_[j]; k < start_[j + 1]; ++k) {
      std::copy_n(gathered(row_[k]), block_size, block(k));
      divide(block(k), diagonal_[j]);
    }
    link(j, start_[j]);
  }
  return true;
}

void BlockFactor::solve(std::vector<Vec3> &b) {
  for (uint32_t j = 0; j < n_; ++j) {
    const Small &s = diagonal_[j];
    Vec3 &x = b[j];
    x[0] *= s.i0;
    x[1] = (x[1] - s.l10 * x[0]) * s.i1;
    x[2] = (x[2] - s.l20 * x[0] - s.l21 * x[1]) * s.i2;
    for (size_t k = start_[j]; k < start_[j + 1]; ++k) {
      const double *a = block(k);
      Vec3 &y = b[row_[k]];
      for (int r = 0; r < 3; ++r) y[r] -= a[r] * x[0] + a[r + 4] * x[1] + a[r + 8] * x[2];
    }
  }
  for (uint32_t j = n_; j-- > 0;) {
    Vec3 x = b[j];
    for (size_t k = start_[j]; k < start_[j + 1]; ++k) {
      const double *a = block(k);
      const Vec3 &y = b[row_[k]];
      for (int c = 0; c < 3; ++c) {
        x[c] -= a[4 * c] * y[0] + a[4 * c + 1] * y[1] + a[4 * c + 2] * y[2];
      }
    }
    const Small &s = diagonal_[j];
    x[2] *= s.i2;
    x[1] = (x[1] - s.l21 * x[2]) * s.i1;
    x[0] = (x[0] - s.l10 * x[1] - s.l20 * x[2]) * s.i0;
    b[j] = x;
  }
}

}  // namespace

std::unique_ptr<Factor> make_block_factor() {
  return std::make_unique<BlockFactor>();
}

}  // namespace mvs
