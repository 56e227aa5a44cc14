// A grid of triangles in the annulus plane.
#include "measure/tenting/height_field.h"

#include <algorithm>
#include <cmath>

namespace mvs::core {
namespace {

constexpr double edge_slack = 1e-9;  // a point on an edge belongs to both its triangles

double cross(const Vec3 &a, const Vec3 &b) {
  return a[0] * b[1] - a[1] * b[0];
}

}  // namespace

HeightField::HeightField(const Frame &frame, const std::vector<Tri> &triangles,
                         const std::vector<Vec3> &x)
    : triangles_(triangles) {
  x_.reserve(x.size());
  for (const Vec3 &p : x) x_.push_back(frame.local(p));
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

  // count, then fill
  const auto for_each_cell = [&](const Tri &t, auto &&visit) {
    const auto u = std::minmax({x_[t[0]][0], x_[t[1]][0], x_[t[2]][0]});
    const auto v = std::minmax({x_[t[0]][1], x_[t[1]][1], x_[t[2]][1]});
    for (size_t i = cell(0, u.first); i <= cell(0, u.second); ++i) {
      for (size_t j = cell(1, v.first); j <= cell(1, v.second); ++j) visit(i * cells_ + j);
    }
  };
  rows_.start.assign(cells_ * cells_ + 1, 0);
  for (const Tri &t : triangles_) for_each_cell(t, [&](size_t c) { ++rows_.start[c + 1]; });
  for (size_t c = 0; c < cells_ * cells_; ++c) rows_.start[c + 1] += rows_.start[c];
  rows_.items.resize(rows_.start.back());
  std::vector<uint32_t> next(rows_.start.begin(), rows_.start.end() - 1);
  for (uint32_t t = 0; t < triangles_.size(); ++t) {
    for_each_cell(triangles_[t], [&](size_t c) { rows_.items[next[c]++] = t; });
  }
}

HeightField::Top HeightField::top(double u, double v) const {
  const size_t c = cell(0, u) * cells_ + cell(1, v);
  Top top;
  for (uint32_t i = rows_.start[c]; i < rows_.start[c + 1]; ++i) {
    const Tri &t = triangles_[rows_.items[i]];
    const Vec3 a = x_[t[0]] - Vec3(u, v, 0), b = x_[t[1]] - Vec3(u, v, 0),
               d = x_[t[2]] - Vec3(u, v, 0);
    const double area = cross(b - a, d - a);
    if (area == 0) continue;
    const double wa = cross(b, d) / area, wb = cross(d, a) / area, wd = 1 - wa - wb;
    if (std::min({wa, wb, wd}) < -edge_slack) continue;
    const double height = wa * a[2] + wb * b[2] + wd * d[2];
    if (top.triangle == none || height > top.height) top = {rows_.items[i], height};
  }
  return top;
}

}  // namespace mvs::core
