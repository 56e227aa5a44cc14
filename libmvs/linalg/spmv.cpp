// Each block is read once, column by column: for its row below the diagonal, and transposed for
// that above it.
#include "linalg/spmv.h"

#include "base/simd.h"

namespace mvs::core {
namespace {

constexpr size_t stride = 4;  // numbers for each row of blocks

constexpr double zeros[stride] = {};

#if defined(__GNUC__)
using Padded = Double4;
#else
struct Padded {
  using Number = double;
  using Value = Eigen::Array4d;
  using Unaligned = Eigen::Array<double, 4, 1, Eigen::DontAlign>;
};
#endif

// The columns of a block; the last number of each register belongs to the next column or block.
struct Columns {
  Padded::Value a, b, c;

  MVS_INLINE explicit Columns(const double *block) {
    load<Padded>(a, block);
    load<Padded>(b, block + 3);
    load<Padded>(c, block + 6);
  }
};

// Multiplies with all columns of the matrix but the last, after whose block a register cannot read.
MVS_INLINE void multiply_columns(const BlockMatrix &matrix, uint32_t columns, const double *v,
                                 double *y) {
  const double *values = matrix.value.front().data();
  const uint32_t *row = matrix.row.data(), *start = matrix.start.data();
  for (uint32_t c = 0; c < columns; ++c) {
    const double x0 = v[stride * c], x1 = v[stride * c + 1], x2 = v[stride * c + 2];
    const Columns diagonal(values + 9 * start[c]);
    const Padded::Value own = diagonal.a * x0 + diagonal.b * x1 + diagonal.c * x2;
    Padded::Value sum0, sum1, sum2;
    load<Padded>(sum0, zeros);
    load<Padded>(sum1, zeros);
    load<Padded>(sum2, zeros);
    for (uint32_t k = start[c] + 1, end = start[c + 1]; k < end; ++k) {
      const Columns block(values + 9 * k);
      Padded::Value of_r, of_y;
      load<Padded>(of_r, v + stride * row[k]);
      load<Padded>(of_y, y + stride * row[k]);
      of_y += block.a * x0 + block.b * x1 + block.c * x2;
      store<Padded>(y + stride * row[k], of_y);
      sum0 += block.a * of_r;
      sum1 += block.b * of_r;
      sum2 += block.c * of_r;
    }
    y[stride * c] += own[0] + (sum0[0] + sum0[1] + sum0[2]);
    y[stride * c + 1] += own[1] + (sum1[0] + sum1[1] + sum1[2]);
    y[stride * c + 2] += own[2] + (sum2[0] + sum2[1] + sum2[2]);
  }
}

}  // namespace

void BlockSpmv::multiply(const BlockMatrix &a, const std::vector<Vec3> &v, std::vector<Vec3> &y) {
  static const auto kernel = simd_kernel<&multiply_columns>();
  const uint32_t n = a.size();
  y.resize(v.size());
  if (n == 0) return;
  v_.resize(stride * n);
  y_.assign(stride * n, 0);
  for (uint32_t r = 0; r < n; ++r) {
    for (uint32_t k = 0; k < 3; ++k) v_[stride * r + k] = v[r][k];
  }
  kernel(a, n - 1, v_.data(), y_.data());
  for (uint32_t r = 0; r < n; ++r) {
    for (uint32_t k = 0; k < 3; ++k) y[r][k] = y_[stride * r + k];
  }
  y[n - 1] += a.value[a.start[n - 1]] * v[n - 1];
}

}  // namespace mvs::core
