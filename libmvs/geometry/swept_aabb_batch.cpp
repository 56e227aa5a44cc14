// Overlap tests of eight swept boxes against a box or against eight others, in single precision, by
// comparisons of the widest registers that the processor has.
#include "geometry/swept_aabb_batch.h"

#include <bit>

#include "base/simd.h"

namespace mvs::core {
namespace {

// The sides of as many boxes as V has elements, moved outwards by a margin.
template <typename V>
struct WidenedAabbs {
  typename V::Value start_low[3], start_high[3], end_low[3], end_high[3];

  MVS_INLINE WidenedAabbs(const SweptAabb8 &boxes, uint32_t first, float margin) {
    for (uint32_t k = 0; k < 3; ++k) {
      load<V>(start_low[k], &boxes.start_low[k][first]);
      load<V>(start_high[k], &boxes.start_high[k][first]);
      load<V>(end_low[k], &boxes.end_low[k][first]);
      load<V>(end_high[k], &boxes.end_high[k][first]);
      start_low[k] = start_low[k] + -margin;
      start_high[k] = start_high[k] + margin;
      end_low[k] = end_low[k] + -margin;
      end_high[k] = end_high[k] + margin;
    }
  }

  // Marks the boxes that a swept interval on axis k is above, or below, at both ends.
  MVS_INLINE void separate(uint32_t k, float from_low, float from_high, float to_low, float to_high,
                           typename V::Mask &apart) const {
    apart |= (start_high[k] < from_low) & (end_high[k] < to_low);
    apart |= (start_low[k] > from_high) & (end_low[k] > to_high);
  }

  // Bits of the boxes that are near one box.
  MVS_INLINE uint32_t near_box(const SweptAabbF &box) const {
    typename V::Mask apart = {};
    for (uint32_t k = 0; k < 3; ++k) {
      separate(k, box.start_low[k], box.start_high[k], box.end_low[k], box.end_high[k], apart);
    }
    return bits_of<V>(~apart);
  }

  MVS_INLINE uint32_t near_box(const SweptAabb8 &boxes, uint32_t i) const {
    typename V::Mask apart = {};
    for (uint32_t k = 0; k < 3; ++k) {
      separate(k, boxes.start_low[k][i], boxes.start_high[k][i], boxes.end_low[k][i],
               boxes.end_high[k][i], apart);
    }
    return bits_of<V>(~apart);
  }
};

template <typename V>
MVS_INLINE uint32_t eight_near_box(const SweptAabb8 &boxes, const SweptAabbF &box, float margin) {
  uint32_t bits = 0;
  for (uint32_t first = 0; first < SweptAabb8::count; first += V::width) {
    bits |= WidenedAabbs<V>(boxes, first, margin).near_box(box) << first;
  }
  return bits;
}

template <typename V>
MVS_INLINE uint32_t eight_near_eight(const SweptAabb8 &here, uint32_t of, const SweptAabb8 &there,
                                     float margin, SweptAabb8::PairBits &near) {
  uint32_t some = 0;
  for (uint32_t first = 0; first < SweptAabb8::count; first += V::width) {
    const WidenedAabbs<V> widened(there, first, margin);
    for (uint32_t left = of; left != 0; left &= left - 1) {
      const auto i = static_cast<uint32_t>(std::countr_zero(left));
      const uint32_t found = widened.near_box(here, i) << first;
      near[i] = first > 0 ? near[i] | found : found;
      some |= (found != 0 ? 1u : 0u) << i;
    }
  }
  return some;
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

uint32_t find_near(const SweptAabb8 &boxes, const SweptAabbF &box, float margin) {
  static const auto kernel = simd_kernel<&eight_near_box<Float4>, &eight_near_box<Float8>>();
  return kernel(boxes, box, margin);
}

uint32_t find_near(const SweptAabb8 &here, uint32_t of, const SweptAabb8 &there, float margin,
                   SweptAabb8::PairBits &near) {
  static const auto kernel = simd_kernel<&eight_near_eight<Float4>, &eight_near_eight<Float8>>();
  return kernel(here, of, there, margin, near);
}

}  // namespace mvs::core
