// Swept boxes in single precision (SweptAabbF), alone and eight at a time (SweptAabb8):
// conservative overlap tests, which never report "apart" for two boxes that are within the margin.
// tests/collision/batches.cpp holds them against boxes in double precision.
#pragma once

#include <cmath>
#include <cstring>

#include "base/simd.h"
#include "base/types.h"

namespace mvs::core {

// Whether all nodes take the same share of their motion at a time, or each node any share.
enum class StepMotion { together, independent };

// Three axes; the fourth number is 0 in all boxes, so that they overlap along it.
using CornerF = std::array<float, 4>;

// The two ends of a node's motion.
struct SweptPointF {
  CornerF start{}, end{};
};

struct SweptAabbF {
  CornerF start_low = empty_side(1), start_high = empty_side(-1);
  CornerF end_low = empty_side(1), end_high = empty_side(-1);

  // Coordinates that are NaN are left out.
  void add(const SweptPointF &point) {
    lower(start_low, point.start);
    raise(start_high, point.start);
    lower(end_low, point.end);
    raise(end_high, point.end);
  }
  void add(const SweptAabbF &other) {
    lower(start_low, other.start_low);
    raise(start_high, other.start_high);
    lower(end_low, other.end_low);
    raise(end_high, other.end_high);
  }
  // Makes both boxes that of the whole motion, for StepMotion::independent.
  void join_ends() {
    lower(start_low, end_low);
    raise(start_high, end_high);
    end_low = start_low;
    end_high = start_high;
  }

 private:
  static constexpr CornerF empty_side(float sign) {
    return {sign * HUGE_VALF, sign * HUGE_VALF, sign * HUGE_VALF, 0};
  }
  static void lower(CornerF &low, const CornerF &other) {
    for (uint32_t k = 0; k < 4; k += Float4::width) {
      Float4::Value mine, its;
      load<Float4>(mine, &low[k]);
      load<Float4>(its, &other[k]);
      store<Float4>(&low[k], its < mine ? its : mine);
    }
  }
  static void raise(CornerF &high, const CornerF &other) {
    for (uint32_t k = 0; k < 4; k += Float4::width) {
      Float4::Value mine, its;
      load<Float4>(mine, &high[k]);
      load<Float4>(its, &other[k]);
      store<Float4>(&high[k], its > mine ? its : mine);
    }
  }
};

// A margin in single precision for boxes whose coordinates are at most `farthest` in size: `margin`
// and the rounding of the sides of both boxes, of their sum with the margin and of the margin
// itself, each at most half a unit in the last place.
inline float float_margin(double margin, double farthest) {
  return static_cast<float>(margin + 4 * 0x1p-24 * (farthest + margin));
}

// Returns true only if two boxes are more than a margin of float_margin() apart.
inline bool surely_apart(const SweptAabbF &a, const SweptAabbF &b, float margin) {
  for (uint32_t k = 0; k < 4; k += Float4::width) {
    const auto at = [k](const CornerF &corner) {
      Float4::Value side;
      load<Float4>(side, &corner[k]);
      return side;
    };
    const Float4::Mask above =
        (at(a.start_low) - margin > at(b.start_high)) & (at(a.end_low) - margin > at(b.end_high));
    const Float4::Mask below =
        (at(a.start_high) + margin < at(b.start_low)) & (at(a.end_high) + margin < at(b.end_low));
    if (bits_of<Float4>(above | below) != 0) return true;
  }
  return false;
}

// Eight swept boxes as a structure of arrays.
struct SweptAabb8 {
  static constexpr uint32_t count = 8;
  using Sides = std::array<std::array<float, count>, 3>;
  // For each of eight boxes, bits of eight others.
  using PairBits = std::array<uint32_t, count>;

  Sides start_low, start_high, end_low, end_high;

  SweptAabb8() { clear(); }
  void clear();  // makes all boxes empty, which find_near() never reports
  void set(uint32_t i, const SweptAabbF &box) {
    for (uint32_t k = 0; k < 3; ++k) {
      start_low[k][i] = box.start_low[k];
      start_high[k][i] = box.start_high[k];
      end_low[k][i] = box.end_low[k];
      end_high[k][i] = box.end_high[k];
    }
  }
};

// Returns a bit for each of eight boxes: 0 only if it is more than a margin of float_margin() apart
// from `box`.
uint32_t find_near(const SweptAabb8 &boxes, const SweptAabbF &box, float margin);

// For each bit i of `of`: bit j of near[i] is 0 only if box i of `here` is more than a margin of
// float_margin() apart from box j of `there`. Returns the bits i for which near[i] is not 0.
uint32_t find_near(const SweptAabb8 &here, uint32_t of, const SweptAabb8 &there, float margin,
                   SweptAabb8::PairBits &near);

}  // namespace mvs::core
