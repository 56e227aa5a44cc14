// Exact arithmetic on floating-point expansions: a number is the sum of nonzero doubles that do not
// overlap, smallest first (Shewchuk, Adaptive Precision Floating-Point Arithmetic and
// Fast Robust Geometric Predicates, 1997). Exact unless a product underflows or overflows, which
// needs coordinates outside 1e-90 .. 1e100. Needs round-to-even and -ffp-contract=off.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace mvs::core {

template <size_t N>
struct Expansion {
  std::array<double, N> part;
  size_t size = 0;

  void push(double value) {
    if (value != 0) part[size++] = value;
  }
  int sign() const { return size == 0 ? 0 : part[size - 1] > 0 ? 1 : -1; }
};

struct TwoDoubles {
  double high, low;  // high is the rounded result, low its error
};

inline TwoDoubles two_sum(double a, double b) {
  const double sum = a + b;
  const double b_part = sum - a;
  return {sum, (a - (sum - b_part)) + (b - b_part)};
}

inline TwoDoubles two_product(double a, double b) {
  const double product = a * b;
  return {product, std::fma(a, b, -product)};
}

// a - b, exact.
inline Expansion<2> exact_difference(double a, double b) {
  const TwoDoubles d = two_sum(a, -b);
  Expansion<2> result;
  result.push(d.low);
  result.push(d.high);
  return result;
}

// FAST-EXPANSION-SUM with zeros dropped (figure 8 of the paper).
template <size_t N, size_t M>
Expansion<N + M> operator+(const Expansion<N> &e, const Expansion<M> &f) {
  Expansion<N + M> result;
  size_t i = 0, j = 0;
  const auto next = [&] {
    const bool from_e = j == f.size || (i < e.size && std::abs(e.part[i]) < std::abs(f.part[j]));
    return from_e ? e.part[i++] : f.part[j++];
  };
  if (e.size + f.size == 0) return result;
  double carry = next();
  while (i < e.size || j < f.size) {
    const TwoDoubles s = two_sum(carry, next());
    result.push(s.low);
    carry = s.high;
  }
  result.push(carry);
  return result;
}

template <size_t N>
Expansion<N> operator-(Expansion<N> e) {
  for (size_t i = 0; i < e.size; ++i) e.part[i] = -e.part[i];
  return e;
}

// SCALE-EXPANSION with zeros dropped (figure 13).
template <size_t N>
Expansion<2 * N> scaled(const Expansion<N> &e, double factor) {
  Expansion<2 * N> result;
  if (e.size == 0) return result;
  TwoDoubles carry = two_product(e.part[0], factor);
  result.push(carry.low);
  for (size_t i = 1; i < e.size; ++i) {
    const TwoDoubles product = two_product(e.part[i], factor);
    const TwoDoubles low = two_sum(carry.high, product.low);
    result.push(low.low);
    carry = two_sum(product.high, low.high);
    result.push(carry.low);
  }
  result.push(carry.high);
  return result;
}

template <size_t N>
Expansion<4 * N> operator*(const Expansion<N> &e, const Expansion<2> &f) {
  const double low = f.size > 0 ? f.part[0] : 0.0, high = f.size > 1 ? f.part[1] : 0.0;
  return scaled(e, low) + scaled(e, high);
}

}  // namespace mvs::core
