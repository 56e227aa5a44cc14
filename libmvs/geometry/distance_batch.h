// Squared distances of batches of pairs by SIMD, with the bits of distance.h.
#pragma once

#include "base/types.h"

namespace mvs::core {

// Structure of arrays of pairs of four points: a point and a triangle, or two segments.
struct DistanceBatch {
  static constexpr uint32_t most = 64;
  using Row = std::array<double, most>;

  std::array<Row, 12> at{};  // x, y, z of the first point, of the second ...
  Row distance2{};

  void set(uint32_t pair, uint32_t point, const Vec3 &place) {
    for (uint32_t k = 0; k < 3; ++k) at[3 * point + k][pair] = place[k];
  }
};

// Sets distance2 of the first `count` pairs: closest_on_triangle() of the first point and the
// others.
void measure_triangles(DistanceBatch &batch, uint32_t count);
// closest_of_segments() of the first two points and the others.
void measure_segments(DistanceBatch &batch, uint32_t count);
// The largest squared distance from any of the first `split` points to any of the others.
void measure_farthest(DistanceBatch &batch, uint32_t count, uint32_t split);

}  // namespace mvs::core
