#include "tests/stability/crossings.h"

#include <cmath>

#include "geometry/intersect.h"

namespace stability {

std::vector<Pair> crossings(const double *x, size_t nodes, const uint32_t *corners,
                            size_t triangles) {
  std::vector<mvs::core::Vec3> points(nodes);
  for (size_t n = 0; n < nodes; ++n)
    points[n] = mvs::core::Vec3(x[3 * n], x[3 * n + 1], x[3 * n + 2]);
  std::vector<mvs::core::Tri> sheet(triangles);
  for (size_t t = 0; t < triangles; ++t) {
    sheet[t] = {corners[3 * t], corners[3 * t + 1], corners[3 * t + 2]};
  }
  std::vector<Pair> found;
  for (const auto &[a, b] : mvs::core::find_intersections(points, sheet)) found.push_back({a, b});
  return found;
}

}  // namespace stability
