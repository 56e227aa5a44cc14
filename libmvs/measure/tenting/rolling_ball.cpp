// A ball rolled over the rows of a raster by the widest registers.
#include "measure/tenting/rolling_ball.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/simd.h"

namespace mvs::core {
namespace {

constexpr size_t across = AnnulusMap::across;

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
  const double *share = map.shares().data();
  const auto start_of = [&](size_t row) { return &from[(row + rows) * padded + side]; };
  for (size_t row = 0; row < across; ++row) {
    double *start = start_of(row);
    for (size_t c = map.first_inside(row); c < map.end_inside(row); ++c) {
      const size_t cell = row * across + c;
      // a cell that is hardly inside is too low to hold the ball
      const double lowered = sign * heights[cell] - 2 * radius * (1 - share[cell]);
      start[c] = share[cell] > 0 ? lowered : -HUGE_VAL;
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
      result[cell] = share[cell] > 0 ? sign * rolled[c] : -HUGE_VAL;
    }
  }
  return result;
}

}  // namespace mvs::core
