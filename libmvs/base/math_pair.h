// Sums of two doubles, and powers of two, for math_powers.cpp and math_angles.cpp (Dekker, Numer.
// Math. 18, 1971).
#pragma once

#include <cstdint>

#include "base/bit_cast.h"

namespace mvs::core::math {

inline constexpr uint64_t exponent_mask = 0xfff0000000000000;
inline constexpr int mantissa_bits = 52, exponent_bias = 1023;

// An unevaluated sum.
struct Pair {
  double high, low;
};

// a + b exactly, for |a| >= |b| or a = 0.
inline Pair fast_two_sum(double a, double b) {
  const double sum = a + b;
  return {sum, b - (sum - a)};
}

// a + b exactly.
inline Pair two_sum(double a, double b) {
  const double sum = a + b, of_b = sum - a;
  return {sum, (a - (sum - of_b)) + (b - of_b)};
}

// The leading 26 bits of a number and the rest.
inline Pair halves(double a) {
  const double shifted = 0x1.0000002p+27 * a;
  const double high = shifted - (shifted - a);
  return {high, a - high};
}

// a b exactly.
inline Pair two_product(double a, double b) {
  const double product = a * b;
  const Pair p = halves(a), q = halves(b);
  return {product, ((p.high * q.high - product) + p.high * q.low + p.low * q.high) + p.low * q.low};
}

// 2^k for a normal result.
inline double power_of_two(int k) {
  return bit_cast<double>(static_cast<uint64_t>(k + exponent_bias) << mantissa_bits);
}

// x 2^k, rounded once more where it is subnormal.
inline double scaled(double x, int k) {
  if (k > 1000) return x * power_of_two(1000) * power_of_two(k - 1000);
  if (k < -1000) return x * power_of_two(k + 1000) * power_of_two(-1000);
  return x * power_of_two(k);
}

// The nearest whole number, for |x| < 2^51.
inline double nearest(double x) {
  constexpr double magic = 0x1.8p+52;
  return (x + magic) - magic;
}

}  // namespace mvs::core::math
