// Table-driven logarithm, exponential and powers: the argument is reduced to a small interval
// around an entry of a table, in which a short Taylor polynomial suffices, and the low parts of the
// leading terms are kept (Tang, ACM Trans. Math. Softw. 15, 1989, for exp; 16, 1990, for log; 18,
// 1992, for expm1).
#include "base/math.h"

#include <cstdint>
#include <limits>

#include "base/bit_cast.h"
#include "base/math_pair.h"
#include "base/math_tables.h"

namespace mvs::core::math {
namespace {

using namespace tables;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

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

}  // namespace mvs::core::math
