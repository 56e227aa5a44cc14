// Triangles drawn row by row, and a ball rolled over rows, by the widest registers.
#include "measure/tenting/height_field.h"

#include <algorithm>
#include <array>
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

// The columns that a triangle covers in a row: those between its sides, and one more at either end.
// A corner counts as on the row within a millionth of the size of the triangle: sides that are
// steeper do not reach out of these columns by edge_slack. A sliver, whose weights are rounding
// errors, has all columns.
class Silhouette {
 public:
  Silhouette(const Vec3 &a, const Vec3 &b, const Vec3 &d, const Range &columns)
      : columns_(columns) {
    const Vec3 u = b - a, v = d - a;
    const double size = std::max({std::abs(u[0]), std::abs(v[0]), std::abs(u[1]), std::abs(v[1])});
    is_sliver_ = std::abs(u[0] * v[1] - u[1] * v[0]) < 1e-9 * size * size;
    near_ = 1e-6 * size;
    sides_ = {side_between(a, b), side_between(b, d), side_between(d, a)};
  }

  // `first`: the centre of the first column; `per_m`: columns for each metre.
  Range in_row(double v, double first, double per_m) const {
    if (is_sliver_) return columns_;
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (const Side &side : sides_) {
      if (v < side.low - near_ || v > side.high + near_) continue;
      const double u = side.u + (std::clamp(v, side.low, side.high) - side.low) * side.slope;
      low = std::min(low, side.is_level ? std::min(side.u, side.u_high) : u);
      high = std::max(high, side.is_level ? std::max(side.u, side.u_high) : u);
    }
    if (low > high) return {1, 0};
    const double from = std::floor((low - first) * per_m), to = std::ceil((high - first) * per_m);
    if (to < static_cast<double>(columns_.first) || from > static_cast<double>(columns_.last)) {
      return {1, 0};
    }
    return {std::max(columns_.first, static_cast<size_t>(std::max(from, 0.0))),
            std::min(columns_.last, static_cast<size_t>(to))};
  }

 private:
  struct Side {
    double low, high, u, u_high, slope;  // u at the lower and higher end
    bool is_level;
  };
  Side side_between(const Vec3 &p, const Vec3 &q) const {
    const Vec3 &low = p[1] <= q[1] ? p : q, &high = p[1] <= q[1] ? q : p;
    const double rise = high[1] - low[1];
    const bool is_level = rise <= near_;
    return {low[1], high[1], low[0], high[0], is_level ? 0 : (high[0] - low[0]) / rise, is_level};
  }

  Range columns_;
  double near_ = 0;
  bool is_sliver_ = false;
  std::array<Side, 3> sides_;
};

// Raises the heights of a row where the triangle covers a centre and is higher.
template <typename V>
MVS_INLINE void raise_row(const RowTriangle &t, const double *columns, size_t first, size_t last,
                          double *top) {
  using Value = typename V::Value;
  const double low = -edge_slack;
  for (size_t at = first; at <= last; at += V::width) {
    // the last register of the raster begins earlier: a height may be raised twice
    const size_t c = at + V::width <= across ? at : across - V::width;
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

// The rises of a ball over the rows r and the columns c from its centre: row r has those of c from
// 0 to reach[r], from rises[first[r]] on. They are the same at -r and at -c.
struct Ball {
  std::vector<ptrdiff_t> reach;
  std::vector<size_t> first;
  std::vector<double> rises;
  ptrdiff_t rows() const { return static_cast<ptrdiff_t>(reach.size()) - 1; }
};

// The largest sum of a neighbour's height and its rise over a ball, for columns `begin` to `end` of
// a row. Of neighbours with the same rise the highest is looked for first, and the rise added once:
// rounding is monotone, so this has the bits of the largest sum. `padded`: length of a row of the
// raster; `pairs`: a buffer for the higher of row r above and below, in rows of this length.
template <typename V>
MVS_INLINE void roll_row(const double *from, size_t padded, const Ball &ball, size_t begin,
                         size_t end, double *pairs, double *to) {
  using Value = typename V::Value;
  const ptrdiff_t rows = ball.rows(), stride = static_cast<ptrdiff_t>(padded);
  const ptrdiff_t side = ball.reach[0], from_column = static_cast<ptrdiff_t>(begin) - side,
                  to_column = static_cast<ptrdiff_t>(end) + side;
  for (ptrdiff_t r = 0; r <= rows; ++r) {
    for (ptrdiff_t c = from_column; c < to_column; c += V::width) {
      Value above, below;
      load<V>(above, from + (c - r * stride));
      load<V>(below, from + (c + r * stride));
      store<V>(pairs + (r * stride + c), above < below ? below : above);
    }
  }
  for (size_t c = begin; c < end; c += V::width) {
    Value best = Value{} - HUGE_VAL;
    for (ptrdiff_t r = 0; r <= rows; ++r) {
      const double *pair = pairs + (r * stride + static_cast<ptrdiff_t>(c));
      const double *rises = ball.rises.data() + ball.first[static_cast<size_t>(r)];
      for (ptrdiff_t k = 0; k <= ball.reach[static_cast<size_t>(r)]; ++k) {
        Value left, right;
        load<V>(left, pair - k);
        load<V>(right, pair + k);
        left = (left < right ? right : left) + rises[k];
        best = best < left ? left : best;
      }
    }
    store<V>(to + c, best);
  }
}

double square(double a) {
  return a * a;
}

Ball ball_of(const AnnulusMap &map, double radius) {
  const int columns = static_cast<int>(std::min(radius / map.width(), across - 1.0));
  const int rows = static_cast<int>(std::min(radius / map.depth(), across - 1.0));
  Ball ball;
  for (int r = 0; r <= rows; ++r) {
    ball.first.push_back(ball.rises.size());
    for (int c = 0; c <= columns; ++c) {
      const double left2 = radius * radius - square(c * map.width()) - square(r * map.depth());
      if (left2 >= 0) ball.rises.push_back(std::sqrt(left2));
    }
    ball.reach.push_back(static_cast<ptrdiff_t>(ball.rises.size() - ball.first.back()) - 1);
  }
  return ball;
}

}  // namespace

std::vector<double> highest_leaflet(const AnnulusMap &map, const std::vector<Tri> &triangles,
                                    const std::vector<Vec3> &local) {
  using R = Registers<double>;
  // gcc selects elements of 512 bits one by one: AVX-512 takes longer than AVX2
  static const auto raise = simd_kernel<&raise_row<R::Baseline>, &raise_row<R::Avx2>>();
  std::vector<double> top(across * across, -HUGE_VAL);
  const double per_m = 1 / (map.u()[1] - map.u()[0]);
  for (const Tri &t : triangles) {
    const Vec3 &a = local[t[0]], &b = local[t[1]], &d = local[t[2]];
    const auto u = std::minmax({a[0], b[0], d[0]}), v = std::minmax({a[1], b[1], d[1]});
    const Range columns = range_of(map.u(), u.first, u.second);
    const Range rows = range_of(map.v(), v.first, v.second);
    if (columns.first > columns.last) continue;
    const Silhouette silhouette(a, b, d, columns);
    for (size_t row = rows.first; row <= rows.last; ++row) {
      const double y = map.v()[row];
      const Range covered = silhouette.in_row(y, map.u()[0], per_m);
      if (covered.first > covered.last) continue;
      raise({{a[0], b[0], d[0]}, {a[1] - y, b[1] - y, d[1] - y}, {a[2], b[2], d[2]}},
            map.u().data(), covered.first, covered.last, &top[row * across]);
    }
  }
  for (size_t row = 0; row < across; ++row) {
    double *cells = &top[row * across];
    const size_t first = map.first_inside(row), end = map.end_inside(row);
    std::fill(cells, cells + first, -HUGE_VAL);
    std::fill(cells + end, cells + across, -HUGE_VAL);
    for (size_t c = first; c < end; ++c) {
      if (!map.inside(row * across + c)) cells[c] = -HUGE_VAL;
    }
  }
  return top;
}

std::vector<double> roll_ball(const AnnulusMap &map, const std::vector<double> &heights,
                              double radius, double sign) {
  using R = Registers<double>;
  static const auto roll =
      simd_kernel<&roll_row<R::Baseline>, &roll_row<R::Avx2>, &roll_row<R::Avx512>>();
  const Ball ball = ball_of(map, radius);
  // rows of the raster with the reach of the ball on every side, and a register more at the end
  const size_t side = static_cast<size_t>(ball.reach[0]), rows = static_cast<size_t>(ball.rows());
  constexpr size_t width = R::Avx512::width;
  const size_t padded = across + 2 * side + width;
  std::vector<double> from(padded * (across + 2 * rows), -HUGE_VAL), pairs(padded * (rows + 1));
  const auto start_of = [&](size_t row) { return &from[(row + rows) * padded + side]; };
  for (size_t row = 0; row < across; ++row) {
    double *start = start_of(row);
    for (size_t c = map.first_inside(row); c < map.end_inside(row); ++c) {
      const size_t cell = row * across + c;
      if (map.inside(cell)) start[c] = sign * heights[cell];
    }
  }
  std::vector<double> result(heights.size(), -HUGE_VAL);
  std::array<double, across> rolled;
  for (size_t row = 0; row < across; ++row) {
    const size_t first = map.first_inside(row), end = map.end_inside(row);
    if (first == end) continue;
    roll(start_of(row), padded, ball, first - first % width, (end + width - 1) / width * width,
         &pairs[side], rolled.data());
    for (size_t c = first; c < end; ++c) {
      const size_t cell = row * across + c;
      if (map.inside(cell)) result[cell] = sign * rolled[c];
    }
  }
  return result;
}

}  // namespace mvs::core
