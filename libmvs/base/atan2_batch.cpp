// atan2 by range reduction to [0, tan(pi / 8)] and a polynomial, without branches, so that the
// compiler works on several numbers at a time.
#include "base/atan2_batch.h"

#include <cmath>
#include <numbers>

#include "base/simd.h"

namespace mvs::core {
namespace {

// atan(t) / t as a polynomial in t^2 for |t| <= tan(pi / 8), interpolated at the zeros of a
// Chebyshev polynomial of degree 12; the error is at most 4e-18.
constexpr double coefficient[] = {
    0.9999999999999999999, -0.3333333333333312,   0.19999999999940887, -0.14285714279249717,
    0.1111111074489341,    -0.09090896808305078,  0.0769204531727064,  -0.06662951656891507,
    0.058468771429319936,  -0.050350971907218905, 0.03796512202489557, -0.017805247117932566};
constexpr size_t coefficients = sizeof coefficient / sizeof coefficient[0];

// Returns 1 or 0. Choices are made by products: a branch would prevent vectorisation.
MVS_INLINE double one_if(bool holds) {
  return holds ? 1.0 : 0.0;
}

// Takes the angle of the smaller coordinate over the larger, turned by pi / 4 if that is nearer to
// 0, and maps it to the octant of (x, y).
MVS_INLINE double arc_tangent(double y, double x) {
  constexpr double pi = std::numbers::pi, tan_8th = 0.41421356237309503;  // of pi / 8
  const double high = std::abs(y), wide = std::abs(x);
  const double small = high < wide ? high : wide, large = high < wide ? wide : high;
  const double turned = one_if(small > tan_8th * large);
  const double steep = one_if(high > wide), behind = one_if(x < 0);
  const double below = large + turned * small;
  const double t = (small - turned * large) / (below + one_if(below == 0)), z = t * t;
  double sum = coefficient[coefficients - 1];
  for (size_t k = coefficients - 1; k-- > 1;) sum = sum * z + coefficient[k];
  const double angle = turned * (pi / 4) + (t + t * (z * sum));
  const double ahead = steep * (pi / 2) + (1 - 2 * steep) * angle;
  return std::copysign(behind * pi + (1 - 2 * behind) * ahead, y);
}

MVS_INLINE void arc_tangents(const double *MVS_RESTRICT y, const double *MVS_RESTRICT x,
                             double *MVS_RESTRICT angle, size_t n) {
  for (size_t k = 0; k < n; ++k) angle[k] = arc_tangent(y[k], x[k]);
}

}  // namespace

void atan2_batch(const double *y, const double *x, double *angle, size_t n) {
  static const auto kernel = simd_kernel<&arc_tangents>();
  kernel(y, x, angle, n);
}

}  // namespace mvs::core
