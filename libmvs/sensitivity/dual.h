// Dual numbers: a value with its derivatives by the coordinates of a few nodes (forward-mode
// automatic differentiation: Griewank & Walther, Evaluating Derivatives, 2008).
#pragma once

#include <array>
#include <cmath>

#include "base/types.h"

namespace mvs::core {

// Derivatives by up to `most` coordinates; `count` of them are in use.
struct Dual {
  static constexpr uint32_t most = 96;
  double value = 0;
  uint32_t count = 0;
  std::array<double, most> slope;  // the first `count` are set

  // A constant.
  Dual(double value_in, uint32_t count_in) : value(value_in), count(count_in) {
    for (uint32_t k = 0; k < count; ++k) slope[k] = 0;
  }

  // f(a) and f(a, b) by the chain rule.
  static Dual chain(const Dual &a, double value, double by_a) {
    Dual r(value, 0);
    r.count = a.count;
    for (uint32_t k = 0; k < a.count; ++k) r.slope[k] = by_a * a.slope[k];
    return r;
  }
  static Dual chain(const Dual &a, const Dual &b, double value, double by_a, double by_b) {
    Dual r(value, 0);
    r.count = a.count;
    for (uint32_t k = 0; k < a.count; ++k) r.slope[k] = by_a * a.slope[k] + by_b * b.slope[k];
    return r;
  }
};

inline Dual operator+(const Dual &a, const Dual &b) {
  return Dual::chain(a, b, a.value + b.value, 1, 1);
}
inline Dual operator-(const Dual &a, const Dual &b) {
  return Dual::chain(a, b, a.value - b.value, 1, -1);
}
inline Dual operator*(const Dual &a, const Dual &b) {
  return Dual::chain(a, b, a.value * b.value, b.value, a.value);
}
inline Dual operator/(const Dual &a, const Dual &b) {
  const double q = a.value / b.value;
  return Dual::chain(a, b, q, 1 / b.value, -q / b.value);
}
inline Dual operator*(double s, const Dual &a) {
  return Dual::chain(a, s * a.value, s);
}
inline Dual sqrt(const Dual &a) {
  const double root = std::sqrt(a.value);
  return Dual::chain(a, root, 0.5 / root);
}

// A vector of dual numbers.
struct Dual3 {
  Dual x, y, z;
};
inline Dual3 operator+(const Dual3 &a, const Dual3 &b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline Dual3 operator-(const Dual3 &a, const Dual3 &b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline Dual3 operator*(double s, const Dual3 &a) {
  return {s * a.x, s * a.y, s * a.z};
}
inline Dual3 operator*(const Dual &s, const Dual3 &a) {
  return {s * a.x, s * a.y, s * a.z};
}
inline Dual dot(const Dual3 &a, const Dual3 &b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline Dual3 cross(const Dual3 &a, const Dual3 &b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline Dual norm(const Dual3 &a) {
  return sqrt(dot(a, a));
}
inline Dual3 normalised(const Dual3 &a) {
  const Dual length = norm(a);
  return {a.x / length, a.y / length, a.z / length};
}

}  // namespace mvs::core
