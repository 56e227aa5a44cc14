// Table-driven elementary functions: the argument is reduced to a small interval around an entry of
// a table, in which a short Taylor polynomial suffices, and the low parts of the leading terms are
// kept (Tang, ACM Trans. Math. Softw. 15, 1989, for exp; 16, 1990, for log; 18, 1992, for expm1;
// Cody and Waite 1980 and Payne and Hanek, ACM SIGNUM Newsl. 18, 1983, for the reduction of angles;
// Dekker, Numer. Math. 18, 1971, for sums and products of two doubles).
#include "base/math.h"

#include <array>
#include <cstdint>
#include <limits>

#include "base/bit_cast.h"
#include "base/math_tables.h"

namespace mvs::core::math {
namespace {

using namespace tables;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr uint64_t exponent_mask = 0xfff0000000000000;
constexpr int mantissa_bits = 52, exponent_bias = 1023;

// An unevaluated sum.
struct Pair {
  double high, low;
};

// a + b exactly, for |a| >= |b| or a = 0.
Pair fast_two_sum(double a, double b) {
  const double sum = a + b;
  return {sum, b - (sum - a)};
}

// a + b exactly.
Pair two_sum(double a, double b) {
  const double sum = a + b, of_b = sum - a;
  return {sum, (a - (sum - of_b)) + (b - of_b)};
}

// The leading 26 bits of a number and the rest.
Pair halves(double a) {
  const double shifted = 0x1.0000002p+27 * a;
  const double high = shifted - (shifted - a);
  return {high, a - high};
}

// a b exactly.
Pair two_product(double a, double b) {
  const double product = a * b;
  const Pair p = halves(a), q = halves(b);
  return {product, ((p.high * q.high - product) + p.high * q.low + p.low * q.high) + p.low * q.low};
}

// 2^k for a normal result.
double power_of_two(int k) {
  return bit_cast<double>(static_cast<uint64_t>(k + exponent_bias) << mantissa_bits);
}

// x 2^k, rounded once more where it is subnormal.
double scaled(double x, int k) {
  if (k > 1000) return x * power_of_two(1000) * power_of_two(k - 1000);
  if (k < -1000) return x * power_of_two(k + 1000) * power_of_two(-1000);
  return x * power_of_two(k);
}

// The nearest whole number, for |x| < 2^51.
double nearest(double x) {
  constexpr double magic = 0x1.8p+52;
  return (x + magic) - magic;
}

// x = 2^k m with the mantissa m of one interval of the table: log x = k log 2 - log c + log(1 + r)
// with r = m c - 1, which the pair holds exactly. c has 10 bits.
struct LogReduction {
  double k;
  const double *row;  // c, the head of -log c, its tail
  Pair r;
};

// For a positive, finite x.
LogReduction reduce_log(double x) {
  int shift = 0;
  if (x < std::numeric_limits<double>::min()) {
    x *= 0x1p54;
    shift = 54;
  }
  const auto bits = bit_cast<uint64_t>(x);
  const uint64_t offset = bits - log_first;
  const auto k = static_cast<int>(static_cast<int64_t>(offset) >> mantissa_bits);
  const auto m = bit_cast<double>(bits - (offset & exponent_mask));
  const double *row = log_table[offset >> 45 & 127];
  const auto head = bit_cast<double>(bit_cast<uint64_t>(m) & 0xffffffff00000000);
  return {static_cast<double>(k - shift), row,
          fast_two_sum(head * row[0] - 1, (m - head) * row[0])};
}

// exp(x + tail) / 2^m = t (1 + p), t from the table.
struct ExpReduction {
  int m;
  const double *t;  // head and tail
  double p;
};

// For |x| < 1000; the tail is smaller than an ulp of x.
ExpReduction reduce_exp(double x, double tail) {
  const double k = nearest(x * exp_per_ln2);
  const double r = ((x - k * exp_ln2_high) - k * exp_ln2_low) + tail;
  const auto whole = static_cast<int>(k);
  const double p =
      r + r * r * (1.0 / 2 + r * (1.0 / 6 + r * (1.0 / 24 + r * (1.0 / 120 + r * (1.0 / 720)))));
  return {whole >> 7, exp_table[whole & 127], p};
}

// exp(x + tail).
double exp_of_sum(double x, double tail) {
  if (x > 710) return infinity;
  if (x < -746) return 0;
  const auto [m, t, p] = reduce_exp(x, tail);
  return scaled(t[0] + (t[1] + t[0] * p), m);
}

// log x for pow, to about 67 bits.
Pair log_in_full(double x) {
  const auto [k, row, r] = reduce_log(x);
  const Pair head = two_sum(k * log_ln2_high + row[1], r.high);
  const Pair square = two_product(r.high, r.high);
  const double a = r.high;
  const double tail =
      a * square.high *
      (1.0 / 3 + a * (-1.0 / 4 + a * (1.0 / 5 + a * (-1.0 / 6 + a * (1.0 / 7 - a * (1.0 / 8))))));
  const Pair sum = two_sum(head.high, -0.5 * square.high);
  const double low = (head.low + (r.low - a * r.low)) + (k * log_ln2_low + row[2]);
  return fast_two_sum(sum.high, sum.low + (low - 0.5 * square.low + tail));
}

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

double log(double x) {
  if (!(x > 0)) return x == 0 ? -infinity : not_a_number;
  if (x == infinity) return infinity;
  const auto [k, row, r] = reduce_log(x);
  const Pair head = fast_two_sum(k * log_ln2_high + row[1], r.high);
  const double a = r.high;
  const double tail =
      a * a * (-1.0 / 2 + a * (1.0 / 3 + a * (-1.0 / 4 + a * (1.0 / 5 + a * (-1.0 / 6 + a / 7)))));
  return head.high + (head.low + r.low + (k * log_ln2_low + row[2]) + tail);
}

double exp(double x) {
  if (std::isnan(x)) return x;
  return exp_of_sum(x, 0);
}

double expm1(double x) {
  if (std::isnan(x)) return x;
  if (x > 710) return infinity;
  if (x < -40) return -1;
  if (std::abs(x) < 0x1p-54) return x;
  if (std::abs(x) < 0.25) {
    double p = 1.0 / 15;
    for (int n = 14; n >= 3; --n) p = (1 + x * p) / n;
    return x + x * x * (0.5 + 0.5 * x * p);
  }
  const auto [m, t, p] = reduce_exp(x, 0);
  // 2^1024 is infinite, 2^1023 times 2 not
  const int half = m > 1000 ? 1 : 0;
  const double scale = power_of_two(m - half);
  const double head = scale * t[0], one = 1.0 / (1 << half);
  const Pair sum = two_sum(head, -one);
  return (sum.high + (sum.low + (scale * t[1] + head * p))) * (1 << half);
}

double pow(double x, double y) {
  if (y == 0 || x == 1) return 1;
  if (std::isnan(x) || std::isnan(y) || x < 0) return not_a_number;
  if (x == 0 || x == infinity) return (x == 0) == (y < 0) ? infinity : 0;
  if (std::isinf(y)) return (x > 1) == (y > 0) ? infinity : 0;
  const Pair log_x = log_in_full(x);
  if (!(std::abs(y * log_x.high) < 800)) return (log_x.high > 0) == (y > 0) ? infinity : 0;
  // if halving y would overflow, the product is out of range or rounds to 0
  if (std::abs(y) > 0x1p900 || std::abs(y) < 0x1p-900) return 1 + y * log_x.high;
  const Pair product = two_product(y, log_x.high);
  const Pair power = fast_two_sum(product.high, product.low + y * log_x.low);
  return exp_of_sum(power.high, power.low);
}

double sin(double x) {
  if (!std::isfinite(x)) return not_a_number;
  if (std::abs(x) < 0x1p-27) return x;
  const double value = sin_of(reduce_angle(std::abs(x)), 0);
  return x < 0 ? -value : value;
}

double cos(double x) {
  if (!std::isfinite(x)) return not_a_number;
  return sin_of(reduce_angle(std::abs(x)), 1);
}

double atan2(double y, double x) {
  if (std::isnan(x) || std::isnan(y)) return not_a_number;
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
