// Collects and sorts the sides of triangles.
#include "model/sides.h"

#include <algorithm>

namespace mvs::core {

std::vector<Side> sorted_sides(const std::vector<Tri> &triangles) {
  std::vector<Side> sides;
  sides.reserve(3 * triangles.size());
  for (uint32_t t = 0; t < triangles.size(); ++t) {
    for (uint32_t k = 0; k < 3; ++k) {
      const uint32_t a = triangles[t][k], b = triangles[t][(k + 1) % 3];
      sides.push_back({{std::min(a, b), std::max(a, b)}, t, k});
    }
  }
  std::sort(sides.begin(), sides.end(), [](const Side &l, const Side &r) {
    return l.edge != r.edge ? l.edge < r.edge : l.triangle < r.triangle;
  });
  return sides;
}

std::vector<uint32_t> neighbours_in(const std::vector<Tri> &triangles,
                                    std::span<const uint32_t> star, uint32_t vertex) {
  std::vector<uint32_t> around;
  for (const uint32_t t : star) {
    for (const uint32_t corner : triangles[t]) {
      if (corner != vertex) around.push_back(corner);
    }
  }
  std::sort(around.begin(), around.end());
  around.erase(std::unique(around.begin(), around.end()), around.end());
  return around;
}

}  // namespace mvs::core
