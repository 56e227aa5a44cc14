// Samples of a surface, and sums of squared distances.
#include "measure/comparison/surface_distance.h"

#include <algorithm>
#include <cmath>

#include "model/sides.h"

namespace mvs::core {

SampledSurface::SampledSurface(const std::vector<Tri> &triangles, const std::vector<Vec3> &x)
    : triangles_(triangles), x_(x), tree_(triangles, x) {
  std::vector<double> at_node(x.size(), 0);
  std::vector<Sample> centroids;
  for (const Tri &t : triangles) {
    const double area = triangle_area(x, t);
    for (const uint32_t node : t) at_node[node] += area / 12;
    centroids.push_back({(x[t[0]] + x[t[1]] + x[t[2]]) / 3, 0.75 * area});
  }
  for (size_t n = 0; n < x.size(); ++n) {
    if (at_node[n] > 0) samples_.push_back({x[n], at_node[n]});
  }
  samples_.insert(samples_.end(), centroids.begin(), centroids.end());
}

Vec3 SampledSurface::normal(uint32_t triangle) const {
  const Tri &t = triangles_[triangle];
  const Vec3 normal = (x_[t[1]] - x_[t[0]]).cross(x_[t[2]] - x_[t[0]]);
  const double length = normal.norm();
  return length > 0 ? Vec3(normal / length) : normal;
}

double SurfaceDistance::rms() const {
  return area > 0 ? std::sqrt(squares / area) : 0;
}

SurfaceDistance operator+(const SurfaceDistance &l, const SurfaceDistance &r) {
  return {l.squares + r.squares, l.area + r.area, std::max(l.max, r.max)};
}

}  // namespace mvs::core
