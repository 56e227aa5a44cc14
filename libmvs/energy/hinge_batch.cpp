// The formulas of HingeFold (energy/hinge.h) in loops that compilers turn into vector instructions.
#include "energy/hinge_batch.h"

#include <cmath>

#include "base/atan2_batch.h"
#include "base/simd.h"

namespace mvs::core {
namespace {

struct Triple {
  double x, y, z;
};

MVS_INLINE Triple difference(const Triple &a, const Triple &b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}

MVS_INLINE Triple cross(const Triple &a, const Triple &b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

// In the order of Eigen's sums.
MVS_INLINE double dot(const Triple &a, const Triple &b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

MVS_INLINE Triple times(double s, const Triple &a) {
  return {s * a.x, s * a.y, s * a.z};
}

MVS_INLINE Triple sum(const Triple &a, const Triple &b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}

MVS_INLINE Triple node_at(const HingeBatch &b, size_t n, size_t k) {
  return {b.x[3 * n][k], b.x[3 * n + 1][k], b.x[3 * n + 2][k]};
}

MVS_INLINE void set_slope(HingeBatch &b, size_t n, size_t k, const Triple &slope) {
  b.slope[3 * n][k] = slope.x;
  b.slope[3 * n + 1][k] = slope.y;
  b.slope[3 * n + 2][k] = slope.z;
}

// Sines and cosines times |N1| |N2|, and the slopes where they are wanted.
template <bool with_slopes>
MVS_INLINE void fold_all(HingeBatch &b, double *MVS_RESTRICT sine, double *MVS_RESTRICT cosine,
                         size_t count) {
  for (size_t k = 0; k < count; ++k) {
    const Triple x0 = node_at(b, 0, k);
    const Triple e = difference(node_at(b, 1, k), x0), c2 = difference(node_at(b, 2, k), x0);
    const Triple c3 = difference(node_at(b, 3, k), x0);
    const Triple n1 = cross(e, c2), n2 = cross(c3, e);
    const double length = std::sqrt(dot(e, e));
    sine[k] = 0 - length * dot(n1, c3);
    cosine[k] = dot(n1, n2);
    if constexpr (with_slopes) {
      const double per_length = 1 / length;
      const double s2 = dot(c2, e) * per_length, s3 = dot(c3, e) * per_length;
      const Triple m1 = times(1 / dot(n1, n1), n1), m2 = times(1 / dot(n2, n2), n2);
      set_slope(b, 0, k, sum(times(length - s2, m1), times(length - s3, m2)));
      set_slope(b, 1, k, sum(times(s2, m1), times(s3, m2)));
      set_slope(b, 2, k, times(-length, m1));
      set_slope(b, 3, k, times(-length, m2));
    }
  }
}

template <bool with_slopes>
MVS_INLINE void find(HingeBatch &batch, size_t count) {
  static const auto kernel = simd_kernel<&fold_all<with_slopes>>();
  HingeBatch::Row sine, cosine;
  kernel(batch, sine.data(), cosine.data(), count);
  atan2_batch(sine.data(), cosine.data(), batch.angle.data(), count);
}

}  // namespace

void find_angles(HingeBatch &batch, size_t count) {
  find<false>(batch, count);
}

void find_slopes(HingeBatch &batch, size_t count) {
  find<true>(batch, count);
}

}  // namespace mvs::core
