// The determinant by its four rows at once, one in each element of a register.
#include "geometry/sphere_side.h"

#include "base/simd.h"

namespace mvs::core {
namespace {

// The determinant is the sum of L V over the rows, L the squared distance from p and V a volume of
// three products z P. L and P are exact, being integers below 2^53. A product z P is off by u
// (2^-53) of itself, V by 3 u of the sum M of the sizes of its products, L V by 4 u of L M, and the
// sum of four by 6 u of the sum of L M, but for terms of second order. 1e-15 is 9 u.
constexpr double rounding = 1e-15;

#if defined(__GNUC__)

using Value = Double4::Value;

#if defined(__clang__)
#define MVS_MIX(v, w, a, b, c, d) __builtin_shufflevector(v, w, a, b, c, d)
#else
typedef long long Picks __attribute__((vector_size(32)));
#define MVS_MIX(v, w, a, b, c, d) __builtin_shuffle(v, w, Picks{a, b, c, d})
#endif
#define MVS_TURN(v, a, b, c, d) MVS_MIX(v, v, a, b, c, d)

// Element k of x, y, z belongs to the k-th point. With the other points in cyclic order, the signs
// of the volumes alternate.
MVS_INLINE SphereSide side(const SpherePoint &a, const SpherePoint &b, const SpherePoint &c,
                           const SpherePoint &d, const SpherePoint &p) {
  Value of_a, of_b, of_c, of_d, of_p;
  load<Double4>(of_a, a.at);
  load<Double4>(of_b, b.at);
  load<Double4>(of_c, c.at);
  load<Double4>(of_d, d.at);
  load<Double4>(of_p, p.at);
  of_a -= of_p;
  of_b -= of_p;
  of_c -= of_p;
  of_d -= of_p;
  const Value xz_ab = MVS_MIX(of_a, of_b, 0, 4, 2, 6), xz_cd = MVS_MIX(of_c, of_d, 0, 4, 2, 6);
  const Value y_ab = MVS_MIX(of_a, of_b, 1, 5, 3, 7), y_cd = MVS_MIX(of_c, of_d, 1, 5, 3, 7);
  const Value x = MVS_MIX(xz_ab, xz_cd, 0, 1, 4, 5), z = MVS_MIX(xz_ab, xz_cd, 2, 3, 6, 7);
  const Value y = MVS_MIX(y_ab, y_cd, 0, 1, 4, 5);
  const Value lift = x * x + y * y + z * z;
  // x y' - x' y with the next point, and with the one after it
  const Value next = x * MVS_TURN(y, 1, 2, 3, 0) - MVS_TURN(x, 1, 2, 3, 0) * y;
  const Value after = x * MVS_TURN(y, 2, 3, 0, 1) - MVS_TURN(x, 2, 3, 0, 1) * y;
  const Value first = MVS_TURN(z, 1, 2, 3, 0) * MVS_TURN(next, 2, 3, 0, 1);
  const Value second = MVS_TURN(z, 2, 3, 0, 1) * MVS_TURN(after, 1, 2, 3, 0);
  const Value third = MVS_TURN(z, 3, 0, 1, 2) * MVS_TURN(next, 1, 2, 3, 0);
  const Value term = lift * (first - second + third);
  Value size_of_first, size_of_second, size_of_third;
  magnitude_of(first, size_of_first);
  magnitude_of(second, size_of_second);
  magnitude_of(third, size_of_third);
  const Value size = lift * (size_of_first + size_of_second + size_of_third);
  const double sum = (term[0] - term[1]) + (term[2] - term[3]);
  const double error = rounding * ((size[0] + size[1]) + (size[2] + size[3]));
  if (sum > error) return SphereSide::inside;
  return sum < -error ? SphereSide::outside : SphereSide::unknown;
}

#else

SphereSide side(const SpherePoint &, const SpherePoint &, const SpherePoint &, const SpherePoint &,
                const SpherePoint &) {
  return SphereSide::unknown;
}

#endif

}  // namespace

SphereSide sphere_side(const SpherePoint &a, const SpherePoint &b, const SpherePoint &c,
                       const SpherePoint &d, const SpherePoint &p) {
  static const auto kernel = simd_kernel<&side>();
  return kernel(a, b, c, d, p);
}

}  // namespace mvs::core
