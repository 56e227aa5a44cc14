// Intersection of triangles with a plane, as segments.
#include "measure/tissue/section.h"

#include <utility>

namespace mvs::core {

std::vector<Vec3> plane_section(const Model &model, const std::vector<Vec3> &x, const Vec3 &point,
                                const Vec3 &normal) {
  const auto height = [&](uint32_t node) { return (x[node] - point).dot(normal); };
  const auto crossing = [&](uint32_t a, uint32_t b) -> Vec3 {
    if (a > b) std::swap(a, b);
    const double ha = height(a), hb = height(b);
    return x[a] + ha / (ha - hb) * (x[b] - x[a]);
  };
  std::vector<Vec3> pairs;
  for (const Tri &triangle : model.valve.triangles) {
    std::array<Vec3, 2> ends;
    size_t count = 0;
    for (size_t k = 0; k < 3; ++k) {
      const uint32_t a = triangle[k], b = triangle[(k + 1) % 3];
      if ((height(a) < 0) != (height(b) < 0)) ends[count++] = crossing(a, b);
    }
    if (count == 2 && ends[0] != ends[1]) pairs.insert(pairs.end(), ends.begin(), ends.end());
  }
  return pairs;
}

}  // namespace mvs::core
