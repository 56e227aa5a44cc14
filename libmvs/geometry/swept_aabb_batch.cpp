// Eight ways against eight others, with the widest vectors that the processor has.
#include "geometry/swept_aabb_batch.h"

#include <bit>

#include "base/simd.h"
#include "base/simd_level.h"

namespace mvs::core {
namespace {

// Lying: what is anywhere in memory. Copied by memcpy, wide vectors would go through the stack,
// sixteen bytes at a time. (Not templates: gcc forgets the alignment of those.)
#if defined(__GNUC__)
struct Four {
  static constexpr uint32_t lanes = 4;
  typedef float Value __attribute__((vector_size(16)));
  typedef int32_t Answers __attribute__((vector_size(16)));
  typedef float Lying __attribute__((vector_size(16), aligned(4), may_alias));
};
struct Eight {
  static constexpr uint32_t lanes = 8;
  typedef float Value __attribute__((vector_size(32)));
  typedef int32_t Answers __attribute__((vector_size(32)));
  typedef float Lying __attribute__((vector_size(32), aligned(4), may_alias));
};
#else
struct Four {
  static constexpr uint32_t lanes = 1;
  typedef float Value;
  typedef int32_t Answers;
  typedef float Lying;
};
#endif

template <typename V>
MVS_INLINE uint32_t all_bits_of(const typename V::Answers &answers) {
  uint32_t bits = 0;
  for (uint32_t first = 0; first < V::lanes; first += simd_width) {
    SimdMask part;
    std::memcpy(&part, reinterpret_cast<const char *>(&answers) + 4 * first, sizeof part);
    bits |= bits_of(part) << first;
  }
  return bits;
}

// As many lanes as V has, with a margin around them.
template <typename V>
struct Widened {
  typename V::Value start_low[3], start_high[3], end_low[3], end_high[3];
};

template <typename V>
MVS_INLINE void take(typename V::Value &to, const float *from, float margin) {
  to = *reinterpret_cast<const typename V::Lying *>(from) + margin;
}

template <typename V>
MVS_INLINE void widen(const SweptAabb8 &lanes, uint32_t first, float margin, Widened<V> &to) {
  for (uint32_t k = 0; k < 3; ++k) {
    take<V>(to.start_low[k], &lanes.start_low[k][first], -margin);
    take<V>(to.start_high[k], &lanes.start_high[k][first], margin);
    take<V>(to.end_low[k], &lanes.end_low[k][first], -margin);
    take<V>(to.end_high[k], &lanes.end_high[k][first], margin);
  }
}

// Along one axis a way is above or below the others at both ends.
template <typename V>
MVS_INLINE void part(const Widened<V> &there, uint32_t k, float start_low, float start_high,
                     float end_low, float end_high, typename V::Answers &apart) {
  apart |= (there.start_high[k] < start_low) & (there.end_high[k] < end_low);
  apart |= (there.start_low[k] > start_high) & (there.end_low[k] > end_high);
}

// Bits of the lanes that are near one way.
template <typename V>
MVS_INLINE uint32_t near_box(const Widened<V> &there, const SweptAabbF &way) {
  typename V::Answers apart = {};
  for (uint32_t k = 0; k < 3; ++k) {
    part<V>(there, k, way.start_low[k], way.start_high[k], way.end_low[k], way.end_high[k], apart);
  }
  return all_bits_of<V>(~apart);
}

template <typename V>
MVS_INLINE uint32_t near_lane(const Widened<V> &there, const SweptAabb8 &here, uint32_t i) {
  typename V::Answers apart = {};
  for (uint32_t k = 0; k < 3; ++k) {
    part<V>(there, k, here.start_low[k][i], here.start_high[k][i], here.end_low[k][i],
            here.end_high[k][i], apart);
  }
  return all_bits_of<V>(~apart);
}

template <typename V>
MVS_INLINE uint32_t near_box_with(const SweptAabb8 &lanes, const SweptAabbF &box, float margin) {
  Widened<V> wide;
  uint32_t bits = 0;
  for (uint32_t first = 0; first < SweptAabb8::count; first += V::lanes) {
    widen<V>(lanes, first, margin, wide);
    bits |= near_box<V>(wide, box) << first;
  }
  return bits;
}

template <typename V>
MVS_INLINE uint32_t near_lanes_with(const SweptAabb8 &here, uint32_t of, const SweptAabb8 &there,
                                    float margin, LaneMasks &near) {
  Widened<V> lanes;
  uint32_t some = 0;
  for (uint32_t first = 0; first < SweptAabb8::count; first += V::lanes) {
    widen<V>(there, first, margin, lanes);
    for (uint32_t left = of; left != 0; left &= left - 1) {
      const auto i = static_cast<uint32_t>(std::countr_zero(left));
      const uint32_t found = near_lane<V>(lanes, here, i) << first;
      near[i] = first > 0 ? near[i] | found : found;
      some |= (found != 0 ? 1u : 0u) << i;
    }
  }
  return some;
}

struct Kernels {
  uint32_t (*box)(const SweptAabb8 &, const SweptAabbF &, float);
  uint32_t (*lanes)(const SweptAabb8 &, uint32_t, const SweptAabb8 &, float, LaneMasks &);
};

// The kernels compiled for a target with V its vectors. Attributes cannot be in parentheses.
// NOLINTBEGIN(bugprone-macro-parentheses)
#define MVS_KERNELS(Name, V, ATTRIBUTE)                                                           \
  struct Name {                                                                                   \
    ATTRIBUTE static uint32_t box(const SweptAabb8 &lanes, const SweptAabbF &around,              \
                                  float margin) {                                                 \
      return near_box_with<V>(lanes, around, margin);                                             \
    }                                                                                             \
    ATTRIBUTE static uint32_t lanes(const SweptAabb8 &here, uint32_t of, const SweptAabb8 &there, \
                                    float margin, LaneMasks &near) {                              \
      return near_lanes_with<V>(here, of, there, margin, near);                                   \
    }                                                                                             \
  }

// NOLINTEND(bugprone-macro-parentheses)

MVS_KERNELS(Plain, Four, );
#if defined(__x86_64__) && defined(__GNUC__)
MVS_KERNELS(Wider, Eight, [[gnu::target("avx2")]]);
#endif

Kernels choose() {
#if defined(__x86_64__) && defined(__GNUC__)
  if (simd_level() >= SimdLevel::avx2) return {&Wider::box, &Wider::lanes};
#endif
  return {&Plain::box, &Plain::lanes};
}

const Kernels &kernels() {
  static const Kernels chosen = choose();
  return chosen;
}

}  // namespace

void SweptAabb8::clear() {
  for (uint32_t k = 0; k < 3; ++k) {
    start_low[k].fill(HUGE_VALF);
    start_high[k].fill(-HUGE_VALF);
  }
  end_low = start_low;
  end_high = start_high;
}

uint32_t find_near(const SweptAabb8 &lanes, const SweptAabbF &box, float margin) {
  return kernels().box(lanes, box, margin);
}

uint32_t find_near(const SweptAabb8 &here, uint32_t of, const SweptAabb8 &there, float margin,
                   LaneMasks &near) {
  return kernels().lanes(here, of, there, margin, near);
}

}  // namespace mvs::core
