// Ways in single precision, four numbers at a time: which of them could come near each other. What
// is near for sure is for apart() to tell.
#pragma once

#if defined(__SSE__)
#include <xmmintrin.h>
#endif

#include <cstring>

#include "base/way.h"

namespace mvs {

// Four numbers in a register where the compiler knows how, one elsewhere.
#if defined(__GNUC__)
typedef float FewNumbers __attribute__((vector_size(16)));
typedef int32_t FewAnswers __attribute__((vector_size(16)));
inline uint32_t bits_of(const FewAnswers &answers) {
#if defined(__SSE__)
  return static_cast<uint32_t>(_mm_movemask_ps(reinterpret_cast<__m128>(answers)));
#else
  const FewAnswers bits = answers & FewAnswers{1, 2, 4, 8};
  return static_cast<uint32_t>((bits[0] | bits[1]) | (bits[2] | bits[3]));
#endif
}
#else
typedef float FewNumbers;
typedef int32_t FewAnswers;
inline uint32_t bits_of(FewAnswers answer) {
  return answer & 1;
}
#endif
inline constexpr uint32_t few = sizeof(FewNumbers) / sizeof(float);

inline FewNumbers take_few(const float *from) {
  FewNumbers numbers;
  std::memcpy(&numbers, from, sizeof numbers);
  return numbers;
}

// How far from the truth a gap between ways inside of `all` can be in single precision: either
// side, the margin and their sum are each off by at most half a unit in the last place.
double narrow_error(const Way &all);

// A way with a margin around it. The fourth axis is nothing: there all are at the same place.
struct NarrowWay {
  using Corner = std::array<float, 4>;

  NarrowWay() = default;
  NarrowWay(const Way &way, double margin);

  Corner start_low, start_high, end_low, end_high;
};

// Whether two ways are apart by their margins for sure.
inline bool surely_apart(const NarrowWay &a, const NarrowWay &b) {
  for (uint32_t k = 0; k < 4; k += few) {
    const auto at = [k](const NarrowWay::Corner &corner) { return take_few(&corner[k]); };
    const FewAnswers above =
        (at(a.start_low) > at(b.start_high)) & (at(a.end_low) > at(b.end_high));
    const FewAnswers below =
        (at(b.start_low) > at(a.start_high)) & (at(b.end_low) > at(a.end_high));
    if (bits_of(above | below) != 0) return true;
  }
  return false;
}

// Eight ways side by side.
class WayLanes {
 public:
  static constexpr uint32_t count = 8;

  void clear();  // to what is nowhere and near nothing
  void set(uint32_t lane, const Way &way);

  // Bit k is set unless lane k is apart from a way by its margin for sure.
  uint32_t near(const NarrowWay &way) const {
    uint32_t lanes = 0;
    for (uint32_t first = 0; first < count; first += few) lanes |= near(way, first) << first;
    return lanes;
  }

 private:
  using Numbers = std::array<std::array<float, count>, 3>;

  uint32_t near(const NarrowWay &way, uint32_t first) const {
    FewAnswers apart = {};
    for (uint32_t k = 0; k < 3; ++k) {
      apart |= (take_few(&start_high_[k][first]) < way.start_low[k]) &
               (take_few(&end_high_[k][first]) < way.end_low[k]);
      apart |= (take_few(&start_low_[k][first]) > way.start_high[k]) &
               (take_few(&end_low_[k][first]) > way.end_high[k]);
    }
    return bits_of(~apart);
  }

  Numbers start_low_, start_high_, end_low_, end_high_;
};

}  // namespace mvs
