// Triangles drawn row by row, and a ball rolled over rows, by the widest registers.
#include "measure/tenting/height_field.h"

#include <algorithm>
#include <cmath>

#include "base/simd.h"

namespace mvs::core {
namespace {

constexpr double edge_slack = 1e-9;  // a point on an edge belongs to both triangles
constexpr size_t across = AnnulusMap::across;

// The columns or rows whose centres are within an interval, and one more at either end.
struct Range {
  size_t first, last;  // first > last: none
};
Range range_of(const std::array<double, across> &centres, double low, double high) {
  const double step = centres[1] - centres[0];
  const auto place = [&](double value) {
    return std::clamp((value - centres[0]) / step, -2.0, across + 2.0);
  };
  const double first = std::floor(place(low)), last = std::ceil(place(high));
  if (last < 0 || first > across - 1) return {1, 0};
  return {static_cast<size_t>(std::max(first, 0.0)),
          static_cast<size_t>(std::min(last, across - 1.0))};
}

// A triangle over one row: corners relative to the row, with u as it is.
struct RowTriangle {
  double u[3], v[3], z[3];
};

// Raises the heights of a row where the triangle covers a centre and is higher. The first column is
// a multiple of the width of the registers.
template <typename V>
MVS_INLINE void raise_row(const RowTriangle &t, const double *columns, size_t first, size_t last,
                          double *top) {
  using Value = typename V::Value;
  const double low = -edge_slack;
  for (size_t c = first - first % V::width; c <= last; c += V::width) {
    Value u, before;
    load<V>(u, columns + c);
    load<V>(before, top + c);
    const Value a = t.u[0] - u, b = t.u[1] - u, d = t.u[2] - u;
    const Value area = (b - a) * (t.v[2] - t.v[0]) - (t.v[1] - t.v[0]) * (d - a);
    const Value wa = (b * t.v[2] - t.v[1] * d) / area, wb = (d * t.v[0] - t.v[2] * a) / area;
    const Value wd = 1.0 - wa - wb;
    const Value height = wa * t.z[0] + wb * t.z[1] + wd * t.z[2];
    const typename V::Mask higher =
        (wa >= low) & (wb >= low) & (wd >= low) & (height > before) & (area != 0.0);
    store<V>(top + c, higher ? height : before);
  }
}

// The largest sum of a neighbour's height and its rise over a ball.
struct Neighbour {
  ptrdiff_t off;  // in the padded raster
  double rise;
};
template <typename V>
MVS_INLINE void roll_row(const double *from, const Neighbour *neighbours, size_t count,
                         double *to) {
  using Value = typename V::Value;
  for (size_t c = 0; c < across; c += V::width) {
    Value best = Value{} - HUGE_VAL;
    for (size_t k = 0; k < count; ++k) {
      Value height;
      load<V>(height, from + (static_cast<ptrdiff_t>(c) + neighbours[k].off));
      height = height + neighbours[k].rise;
      best = best < height ? height : best;
    }
    store<V>(to + c, best);
  }
}

double square(double a) {
  return a * a;
}

}  // namespace

std::vector<double> highest_leaflet(const AnnulusMap &map, const std::vector<Tri> &triangles,
                                    const std::vector<Vec3> &local) {
  using R = Registers<double>;
  static const auto raise =
      simd_kernel<&raise_row<R::Baseline>, &raise_row<R::Avx2>, &raise_row<R::Avx512>>();
  std::vector<double> top(across * across, -HUGE_VAL);
  for (const Tri &t : triangles) {
    const Vec3 &a = local[t[0]], &b = local[t[1]], &d = local[t[2]];
    const auto u = std::minmax({a[0], b[0], d[0]}), v = std::minmax({a[1], b[1], d[1]});
    const Range columns = range_of(map.u(), u.first, u.second);
    const Range rows = range_of(map.v(), v.first, v.second);
    if (columns.first > columns.last) continue;
    for (size_t row = rows.first; row <= rows.last; ++row) {
      const double y = map.v()[row];
      raise({{a[0], b[0], d[0]}, {a[1] - y, b[1] - y, d[1] - y}, {a[2], b[2], d[2]}},
            map.u().data(), columns.first, columns.last, &top[row * across]);
    }
  }
  for (size_t c = 0; c < top.size(); ++c) {
    if (!map.inside(c)) top[c] = -HUGE_VAL;
  }
  return top;
}

std::vector<double> roll_ball(const AnnulusMap &map, const std::vector<double> &heights,
                              double radius, double sign) {
  using R = Registers<double>;
  static const auto roll =
      simd_kernel<&roll_row<R::Baseline>, &roll_row<R::Avx2>, &roll_row<R::Avx512>>();
  const int most = static_cast<int>(across);
  const int columns = static_cast<int>(std::min(radius / map.width(), most - 1.0));
  const int rows = static_cast<int>(std::min(radius / map.depth(), most - 1.0));
  const size_t padded = across + 2 * static_cast<size_t>(columns);
  std::vector<Neighbour> ball;
  for (int r = -rows; r <= rows; ++r) {
    for (int c = -columns; c <= columns; ++c) {
      const double left2 = radius * radius - square(c * map.width()) - square(r * map.depth());
      if (left2 >= 0) ball.push_back({r * static_cast<ptrdiff_t>(padded) + c, std::sqrt(left2)});
    }
  }
  std::vector<double> from(padded * (across + 2 * static_cast<size_t>(rows)), -HUGE_VAL);
  const auto start_of = [&](size_t row) {
    return &from[(row + static_cast<size_t>(rows)) * padded + static_cast<size_t>(columns)];
  };
  for (size_t c = 0; c < heights.size(); ++c) {
    if (map.inside(c)) start_of(c / across)[c % across] = sign * heights[c];
  }
  std::vector<double> result(heights.size());
  for (size_t row = 0; row < across; ++row) {
    roll(start_of(row), ball.data(), ball.size(), &result[row * across]);
  }
  for (size_t c = 0; c < result.size(); ++c) {
    result[c] = map.inside(c) ? sign * result[c] : -HUGE_VAL;
  }
  return result;
}

}  // namespace mvs::core
