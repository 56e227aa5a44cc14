// Sine, cosine and arc tangent: the angle is reduced to within pi / 4 of a multiple of pi / 2 (Cody
// and Waite 1980; large ones as Payne and Hanek, ACM SIGNUM Newsl. 18, 1983), a ratio of sides to
// within 1/32 of an entry of a table; then a short Taylor polynomial suffices.
#include "base/math.h"

#include <array>
#include <cstdint>
#include <limits>

#include "base/bit_cast.h"
#include "base/math_pair.h"
#include "base/math_tables.h"

namespace mvs::core::math {
namespace {

using namespace tables;

// A reduced angle r within pi / 4, and its quadrant.
struct Angle {
  Pair r;
  uint32_t quadrant;
};

// Computes the fraction of m 2^e (2 / pi) in integers, m and e of x, from the digits of 2 / pi that
// give neither multiples of 4 nor less than 2^-150.
Angle reduce_any_angle(double x) {
  constexpr int words = 8, limbs = words + 2;
  const auto bits = bit_cast<uint64_t>(x);
  const int exponent =
      static_cast<int>(bits >> mantissa_bits & 2047) - exponent_bias - mantissa_bits;
  const uint64_t m = (bits & ~exponent_mask) | uint64_t{1} << mantissa_bits;
  const int skipped = exponent > 2 ? (exponent - 2) / 32 : 0;
  // the product, the lowest limb first
  std::array<uint64_t, limbs> product{};
  for (int k = 0; k < words; ++k) {
    const uint64_t digit = two_over_pi[skipped + words - 1 - k];
    const uint64_t low = (m & 0xffffffff) * digit, sum = product[k] + (low & 0xffffffff);
    product[k] = sum & 0xffffffff;
    product[k + 1] += (m >> 32) * digit + (low >> 32) + (sum >> 32);
  }
  product[limbs - 1] += product[limbs - 2] >> 32;
  product[limbs - 2] &= 0xffffffff;
  // 2 bits before the point, then the fraction
  const int point = 32 * (skipped + words) - exponent;
  const auto bit = [&](int k) { return k < 32 * limbs ? product[k / 32] >> (k % 32) & 1 : 0; };
  auto quadrant = static_cast<uint32_t>(bit(point) + 2 * bit(point + 1));
  const bool above_half = bit(point - 1) != 0;
  if (above_half) ++quadrant;
  Pair fraction = {0, 0};
  for (int k = (point - 1) / 32; k >= 0; --k) {
    uint64_t limb = product[k];
    if (k == (point - 1) / 32) limb &= (uint64_t{2} << ((point - 1) % 32)) - 1;
    const double part = scaled(static_cast<double>(limb), 32 * k - point);
    const Pair sum = two_sum(fraction.high, part);
    fraction = {sum.high, fraction.low + sum.low};
    if (above_half && k == (point - 1) / 32) fraction.high -= 1;
  }
  fraction = fast_two_sum(fraction.high, fraction.low);
  const Pair r = two_product(fraction.high, half_pi_high);
  const double low = r.low + (fraction.high * half_pi_low + fraction.low * half_pi_high);
  return {fast_two_sum(r.high, low), quadrant};
}

// For x >= 0.
Angle reduce_angle(double x) {
  if (x < 0.78) return {{x, 0}, 0};
  if (x < 0x1p20) {
    const double k = nearest(x * two_over_pi_rounded);
    const Pair r = two_sum(x - k * half_pi_1, -k * half_pi_2);
    // nearer to a multiple of pi / 2 the third part of it has too few digits
    if (std::abs(r.high) > 0x1p-20) {
      return {fast_two_sum(r.high, r.low - k * half_pi_3), static_cast<uint32_t>(k)};
    }
  }
  return reduce_any_angle(x);
}

double sin_of_small(Pair r) {
  const double a = r.high, z = a * a;
  const double p =
      -1.0 / 6 +
      z * (1.0 / 120 +
           z * (-1.0 / 5040 + z * (1.0 / 362880 + z * (-1.0 / 39916800 +
                                                       z * (1.0 / 6227020800 +
                                                            z * (-1.0 / 1307674368000 +
                                                                 z * (1.0 / 355687428096000)))))));
  return a + (r.low * (1 - 0.5 * z) + a * z * p);
}

double cos_of_small(Pair r) {
  const double a = r.high, z = a * a;
  const double p =
      1.0 / 24 +
      z * (-1.0 / 720 +
           z * (1.0 / 40320 +
                z * (-1.0 / 3628800 + z * (1.0 / 479001600 + z * (-1.0 / 87178291200 +
                                                                  z * (1.0 / 20922789888000))))));
  const double head = 1 - 0.5 * z;
  return head + (((1 - head) - 0.5 * z) + (z * z * p - a * r.low));
}

// Returns the sine of a reduced angle plus `more` right angles.
double sin_of(const Angle &angle, uint32_t more) {
  const uint32_t quadrant = angle.quadrant + more;
  const double value = (quadrant & 1) != 0 ? cos_of_small(angle.r) : sin_of_small(angle.r);
  return (quadrant & 2) != 0 ? -value : value;
}

// atan(small / large) for 0 <= small <= large, large about 1.
Pair atan_of_ratio(double small, double large) {
  const double k = nearest(16 * small / large);
  const double c = k / 16;
  // the tangent of the remaining angle: (small - c large) / (large + c small)
  const Pair down = two_product(c, large), up = two_product(c, small);
  const Pair above = two_sum(small, -down.high), below = two_sum(large, up.high);
  const double left = above.low - down.low, right = below.low + up.low;
  const double q = above.high / below.high;
  const Pair product = two_product(q, below.high);
  const double rest = ((above.high - product.high) - product.low + left - q * right) / below.high;
  const double z = q * q;
  const double p =
      -1.0 / 3 + z * (1.0 / 5 + z * (-1.0 / 7 + z * (1.0 / 9 + z * (-1.0 / 11 + z * (1.0 / 13)))));
  const double *angle = atan_table[static_cast<int>(k)];
  const Pair sum = fast_two_sum(angle[0], q);
  return {sum.high, sum.low + (angle[1] + (rest + q * z * p))};
}

// atan2 for y, x >= 0, not both 0.
Pair atan_of(double y, double x) {
  const double large = y > x ? y : x;
  const auto bits = bit_cast<uint64_t>(large);
  const int exponent = static_cast<int>(bits >> mantissa_bits) - exponent_bias;
  // scaled to about 1, so that products of halves neither overflow nor underflow
  const double a = scaled(y, -exponent / 2) * power_of_two(-exponent - -exponent / 2);
  const double b = scaled(x, -exponent / 2) * power_of_two(-exponent - -exponent / 2);
  if (y <= x) return atan_of_ratio(a, b);
  const Pair angle = atan_of_ratio(b, a);
  const Pair sum = fast_two_sum(half_pi_high, -angle.high);
  return {sum.high, sum.low + (half_pi_low - angle.low)};
}

}  // namespace

double sin(double x) {
  if (!std::isfinite(x)) return std::numeric_limits<double>::quiet_NaN();
  if (std::abs(x) < 0x1p-27) return x;
  const double value = sin_of(reduce_angle(std::abs(x)), 0);
  return x < 0 ? -value : value;
}

double cos(double x) {
  if (!std::isfinite(x)) return std::numeric_limits<double>::quiet_NaN();
  return sin_of(reduce_angle(std::abs(x)), 1);
}

double atan2(double y, double x) {
  if (std::isnan(x) || std::isnan(y)) return std::numeric_limits<double>::quiet_NaN();
  double a = std::abs(y), b = std::abs(x);
  if (std::isinf(a) || std::isinf(b)) {
    a = std::isinf(a) ? 1 : 0;
    b = std::isinf(b) ? 1 : 0;
  }
  Pair angle = {0, 0};
  if (a > 0 && b > 0) {
    // below 2^-60 of the other one, a leg does not change the result
    if (b > 0x1p60 * a) {
      angle = {a / b, 0};
    } else if (a > 0x1p60 * b) {
      angle = {half_pi_high, half_pi_low};
    } else {
      angle = atan_of(a, b);
    }
  } else if (a > 0) {
    angle = {half_pi_high, half_pi_low};
  }
  if (std::signbit(x)) {
    const Pair sum = two_sum(2 * half_pi_high, -angle.high);
    angle = {sum.high, sum.low + (2 * half_pi_low - angle.low)};
  }
  return std::copysign(angle.high + angle.low, y);
}

}  // namespace mvs::core::math
