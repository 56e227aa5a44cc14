// Exact integer arithmetic of points, and whether the convex hulls of a few points meet, as a
// reference for predicates in floating point.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

#include "base/types.h"

namespace mvs::core::integer {

// Coordinates below 2^30 keep a 3 x 3 determinant of differences below 2^96.
__extension__ typedef __int128 Int;
using IntVec = std::array<int64_t, 3>;

inline IntVec minus(const IntVec &a, const IntVec &b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
inline Vec3 real(const IntVec &a) {
  return {static_cast<double>(a[0]), static_cast<double>(a[1]), static_cast<double>(a[2])};
}
inline std::array<Int, 3> cross(const IntVec &a, const IntVec &b) {
  return {Int{a[1]} * b[2] - Int{a[2]} * b[1], Int{a[2]} * b[0] - Int{a[0]} * b[2],
          Int{a[0]} * b[1] - Int{a[1]} * b[0]};
}
template <typename A, typename B>
Int dot(const A &a, const B &b) {
  return Int{a[0]} * b[0] + Int{a[1]} * b[1] + Int{a[2]} * b[2];
}
inline bool is_zero(const std::array<Int, 3> &a) {
  return a[0] == 0 && a[1] == 0 && a[2] == 0;
}
inline Int det(const IntVec &a, const IntVec &b, const IntVec &c) {
  return dot(cross(a, b), c);
}
inline int sign(Int value) {
  return (value > 0) - (value < 0);
}

// Whether the origin is a convex combination of points. By Caratheodory, four, three, two or one
// independent points suffice; combinations of dependent points are found among fewer points.
inline bool spans_origin(const IntVec &p) {
  return p == IntVec{0, 0, 0};
}
inline bool spans_origin(const IntVec &p, const IntVec &q) {
  return is_zero(cross(p, q)) && dot(p, q) <= 0;
}
inline bool spans_origin(const IntVec &p, const IntVec &q, const IntVec &r) {
  if (det(p, q, r) != 0) return false;
  const std::array<Int, 3> normal = cross(minus(q, p), minus(r, p));
  if (is_zero(normal)) return false;
  return dot(normal, cross(p, q)) >= 0 && dot(normal, cross(q, r)) >= 0 &&
         dot(normal, cross(r, p)) >= 0;
}
inline bool spans_origin(const IntVec &p, const IntVec &q, const IntVec &r, const IntVec &s) {
  const int whole = sign(det(minus(q, p), minus(r, p), minus(s, p)));
  if (whole == 0) return false;
  return whole * sign(det(q, r, s)) >= 0 && whole * sign(det(p, r, s)) <= 0 &&
         whole * sign(det(p, q, s)) >= 0 && whole * sign(det(p, q, r)) <= 0;
}

// Convex hulls meet when their difference contains the origin.
inline bool hulls_meet(const std::vector<IntVec> &a, const std::vector<IntVec> &b) {
  std::vector<IntVec> d;
  for (const IntVec &p : a) {
    for (const IntVec &q : b) d.push_back(minus(p, q));
  }
  for (size_t i = 0; i < d.size(); ++i) {
    if (spans_origin(d[i])) return true;
    for (size_t j = 0; j < i; ++j) {
      if (spans_origin(d[i], d[j])) return true;
      for (size_t k = 0; k < j; ++k) {
        if (spans_origin(d[i], d[j], d[k])) return true;
        for (size_t l = 0; l < k; ++l) {
          if (spans_origin(d[i], d[j], d[k], d[l])) return true;
        }
      }
    }
  }
  return false;
}

inline IntVec random_point(std::mt19937 &random, int64_t range) {
  std::uniform_int_distribution<int64_t> coordinate(-range, range);
  const int64_t i = coordinate(random), j = coordinate(random), k = coordinate(random);
  return {i, j, k};
}

}  // namespace mvs::core::integer
