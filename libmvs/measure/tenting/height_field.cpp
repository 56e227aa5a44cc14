// Triangles in a uniform grid over the annulus plane.
#include "measure/tenting/height_field.h"

#include <algorithm>
#include <cmath>

namespace mvs::core {
namespace {

constexpr double edge_slack = 1e-9;  // a point on an edge belongs to both triangles

}  // namespace

HeightField::HeightField(const Frame &frame, const std::vector<Tri> &triangles,
                         const std::vector<Vec3> &x)
    : triangles_(triangles), x_(frame.local(x)) {
  list_triangles();
}

size_t HeightField::cell(size_t axis, double value) const {
  const double place = std::floor((value - low_[axis]) / step_[axis]);
  return static_cast<size_t>(std::clamp(place, 0.0, static_cast<double>(cells_ - 1)));
}

void HeightField::list_triangles() {
  std::array<double, 2> high = {-HUGE_VAL, -HUGE_VAL};
  low_ = {HUGE_VAL, HUGE_VAL};
  for (const Tri &triangle : triangles_) {
    for (const uint32_t node : triangle) {
      for (size_t axis = 0; axis < 2; ++axis) {
        low_[axis] = std::min(low_[axis], x_[node][axis]);
        high[axis] = std::max(high[axis], x_[node][axis]);
      }
    }
  }
  cells_ = 1 + static_cast<size_t>(std::sqrt(static_cast<double>(triangles_.size())));
  for (size_t axis = 0; axis < 2; ++axis) {
    step_[axis] = (high[axis] - low_[axis]) / static_cast<double>(cells_);
  }

  rows_ = build_rows(cells_ * cells_, [&](auto visit) {
    for (uint32_t n = 0; n < triangles_.size(); ++n) {
      const Tri &t = triangles_[n];
      const auto u = std::minmax({x_[t[0]][0], x_[t[1]][0], x_[t[2]][0]});
      const auto v = std::minmax({x_[t[0]][1], x_[t[1]][1], x_[t[2]][1]});
      for (size_t i = cell(0, u.first); i <= cell(0, u.second); ++i) {
        for (size_t k = cell(1, v.first); k <= cell(1, v.second); ++k) visit(i * cells_ + k, n);
      }
    }
  });
}

HeightField::Top HeightField::top(double u, double v) const {
  const size_t c = cell(0, u) * cells_ + cell(1, v);
  Top top;
  for (uint32_t i = rows_.start[c]; i < rows_.start[c + 1]; ++i) {
    const Tri &t = triangles_[rows_.items[i]];
    const Vec3 a = x_[t[0]] - Vec3(u, v, 0), b = x_[t[1]] - Vec3(u, v, 0),
               d = x_[t[2]] - Vec3(u, v, 0);
    const double area = cross_in_plane(b - a, d - a);
    if (area == 0) continue;
    const double wa = cross_in_plane(b, d) / area, wb = cross_in_plane(d, a) / area,
                 wd = 1 - wa - wb;
    if (std::min({wa, wb, wd}) < -edge_slack) continue;
    const double height = wa * a[2] + wb * b[2] + wd * d[2];
    if (top.triangle == none || height > top.height) top = {rows_.items[i], height};
  }
  return top;
}

}  // namespace mvs::core
