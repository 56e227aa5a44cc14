// Ways in single precision, many numbers at a time: which of them could come near each other. What
// is near for sure is for apart() to tell.
#pragma once

#if defined(__SSE__)
#include <xmmintrin.h>
#endif

#include <cmath>
#include <cstring>

#include "geometry/swept_aabb.h"

namespace mvs::core {

// Four numbers in a register where the compiler knows how, one elsewhere.
#if defined(__GNUC__)
typedef float SimdFloat __attribute__((vector_size(16)));
typedef int32_t SimdMask __attribute__((vector_size(16)));
inline uint32_t bits_of(const SimdMask &answers) {
#if defined(__SSE__)
  return static_cast<uint32_t>(_mm_movemask_ps(reinterpret_cast<__m128>(answers)));
#else
  const SimdMask bits = answers & SimdMask{1, 2, 4, 8};
  return static_cast<uint32_t>((bits[0] | bits[1]) | (bits[2] | bits[3]));
#endif
}
#else
typedef float SimdFloat;
typedef int32_t SimdMask;
inline uint32_t bits_of(SimdMask answer) {
  return answer & 1;
}
#endif
inline constexpr uint32_t simd_width = sizeof(SimdFloat) / sizeof(float);

inline SimdFloat load_simd(const float *from) {
  SimdFloat numbers;
  std::memcpy(&numbers, from, sizeof numbers);
  return numbers;
}

inline SimdMask load_simd(const int32_t *from) {
  SimdMask numbers;
  std::memcpy(&numbers, from, sizeof numbers);
  return numbers;
}

// Three axes; the fourth is nothing: there all are at the same place.
using CornerF = std::array<float, 4>;

// Where a node is at both ends of its way.
struct SweptPointF {
  CornerF start{}, end{};
};

struct SweptAabbF {
  CornerF start_low = nowhere(1), start_high = nowhere(-1);
  CornerF end_low = nowhere(1), end_high = nowhere(-1);

  // What is no number is left out.
  void add(const SweptPointF &place) {
    lower(start_low, place.start);
    raise(start_high, place.start);
    lower(end_low, place.end);
    raise(end_high, place.end);
  }
  void add(const SweptAabbF &other) {
    lower(start_low, other.start_low);
    raise(start_high, other.start_high);
    lower(end_low, other.end_low);
    raise(end_high, other.end_high);
  }
  // Of what goes for itself (see Way).
  void join_ends() {
    lower(start_low, end_low);
    raise(start_high, end_high);
    end_low = start_low;
    end_high = start_high;
  }

 private:
  static constexpr CornerF nowhere(float sign) {
    return {sign * HUGE_VALF, sign * HUGE_VALF, sign * HUGE_VALF, 0};
  }
  static void lower(CornerF &low, const CornerF &other) {
    for (uint32_t k = 0; k < 4; k += simd_width) {
      const SimdFloat mine = load_simd(&low[k]), its = load_simd(&other[k]);
      const SimdFloat least = its < mine ? its : mine;
      std::memcpy(&low[k], &least, sizeof least);
    }
  }
  static void raise(CornerF &high, const CornerF &other) {
    for (uint32_t k = 0; k < 4; k += simd_width) {
      const SimdFloat mine = load_simd(&high[k]), its = load_simd(&other[k]);
      const SimdFloat most = its > mine ? its : mine;
      std::memcpy(&high[k], &most, sizeof most);
    }
  }
};

// A margin for ways between places no farther than `farthest` from zero along any axis, with what
// rounding may take from it: the sides of both, their sum with the margin and the margin itself are
// each off by at most half a unit in the last place.
inline float float_margin(double margin, double farthest) {
  return static_cast<float>(margin + 4 * 0x1p-24 * (farthest + margin));
}

// Whether two ways are apart by a margin from narrow_margin() for sure.
inline bool surely_apart(const SweptAabbF &a, const SweptAabbF &b, float margin) {
  for (uint32_t k = 0; k < 4; k += simd_width) {
    const auto at = [k](const CornerF &corner) { return load_simd(&corner[k]); };
    const SimdMask above =
        (at(a.start_low) - margin > at(b.start_high)) & (at(a.end_low) - margin > at(b.end_high));
    const SimdMask below =
        (at(a.start_high) + margin < at(b.start_low)) & (at(a.end_high) + margin < at(b.end_low));
    if (bits_of(above | below) != 0) return true;
  }
  return false;
}

// Eight ways side by side.
struct SweptAabb8 {
  static constexpr uint32_t count = 8;
  using Numbers = std::array<std::array<float, count>, 3>;

  Numbers start_low, start_high, end_low, end_high;

  SweptAabb8() { clear(); }
  void clear();  // to what is nowhere and near nothing
  void set(uint32_t lane, const SweptAabbF &way) {
    for (uint32_t k = 0; k < 3; ++k) {
      start_low[k][lane] = way.start_low[k];
      start_high[k][lane] = way.start_high[k];
      end_low[k][lane] = way.end_low[k];
      end_high[k][lane] = way.end_high[k];
    }
  }
};

// For each lane, bits of the lanes of others.
using LaneMasks = std::array<uint32_t, SweptAabb8::count>;

// Bit i is set unless lane i is apart from a box by a margin from narrow_margin() for sure.
uint32_t find_near(const SweptAabb8 &lanes, const SweptAabbF &box, float margin);

// For the bits i of `of`: bit j of near[i] is set unless lane i of `here` is apart from lane j of
// `there` by a margin from narrow_margin() for sure. Returns the bits of those that have any.
uint32_t find_near(const SweptAabb8 &here, uint32_t of, const SweptAabb8 &there, float margin,
                   LaneMasks &near);

}  // namespace mvs::core
