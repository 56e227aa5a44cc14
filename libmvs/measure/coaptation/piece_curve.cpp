// Local linear regression over the parameter of the pieces.
#include "measure/coaptation/piece_curve.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "base/simd.h"

namespace mvs::core {
namespace {

constexpr double window = 0.125;  // half width of the regression, share of the line
constexpr int steps = 32;
// Least variance of the parameter among the pieces of a regression, in half widths squared, for
// which they determine the point alone. At an end of a line it is 1/20 to 1/18; of pieces that
// reach into a window by 0.42 of its half width it is 0.01.
constexpr double least_variance = 0.01;
// Weight of the pieces of a regression, over the area of the line, from which the same holds.
constexpr double whole_weight = 4e-3;
// The share at the least variance of 0: a line of pieces with one parameter is that point.
constexpr double smallest = 0.01;
// How much more a point follows its neighbours than its share says: a chain of points without
// pieces pulls less the longer it is, so that the first traces of area would pull it over a gap.
constexpr double bridge = 5;

// Weighted sums over pieces: of 1, t, t^2, and of the middles times 1 and t.
struct Moments {
  std::array<double, 4> one{}, t{};  // of the middle and of 1
  double tt = 0;
};

// Sums the pieces within a width of a parameter; t is the distance from it over the width. The
// elements of a register are coordinates of one piece, so that every sum is in the order of pieces.
template <typename V>
MVS_INLINE void sum_moments(std::span<const OrderedPiece> pieces, double at, double width,
                            Moments &moments) {
  using Value = typename V::Value;
  constexpr size_t registers = 4 / V::width;
  Value one[registers] = {}, with_t[registers] = {};
  double tt = 0;
  for (const OrderedPiece &piece : pieces) {
    const double t = width > 0 ? (piece.order - at) / width : 0;
    const double left = 1 - std::abs(t), weight = piece.area * (left > 0 ? left : 0.0);
    const double weight_t = weight * t;
    tt += weight_t * t;
    for (size_t k = 0; k < registers; ++k) {
      Value middle;
      load<V>(middle, piece.middle_and_one.data() + k * V::width);
      one[k] = one[k] + (Value{} + weight) * middle;
      with_t[k] = with_t[k] + (Value{} + weight_t) * middle;
    }
  }
  for (size_t k = 0; k < registers; ++k) {
    store<V>(moments.one.data() + k * V::width, one[k]);
    store<V>(moments.t.data() + k * V::width, with_t[k]);
  }
  moments.tt = tt;
}

// Local linear regression (Cleveland, JASA 74, 1979) at one parameter: unlike a mean it is not
// biased inwards at the ends. Pieces are sorted. Returns from 0 to 1 how far they determine the
// point: not where they have hardly any area, or cover little of the window, so that a line through
// them would throw the point anywhere. Of 0 the point is not set.
double regress(const std::vector<OrderedPiece> &pieces, double area, double at, double width,
               Vec3 &point) {
  static const auto sum = simd_kernel<&sum_moments<Double2>, &sum_moments<Double4>>();
  const auto first =
      std::partition_point(pieces.begin(), pieces.end(),
                           [&](const OrderedPiece &piece) { return piece.order < at - width; });
  const auto end = std::partition_point(
      first, pieces.end(), [&](const OrderedPiece &piece) { return piece.order <= at + width; });
  Moments moments;
  const auto begin = static_cast<size_t>(first - pieces.begin());
  sum(std::span(pieces).subspan(begin, static_cast<size_t>(end - first)), at, width, moments);
  const double w = moments.one[3], wt = moments.t[3], wtt = moments.tt;
  const Vec3 wp(moments.one[0], moments.one[1], moments.one[2]);
  const Vec3 wtp(moments.t[0], moments.t[1], moments.t[2]);
  if (w == 0) return 0;
  const double determinant = w * wtt - wt * wt, least = least_variance * w * w;
  point = determinant >= least ? Vec3((wtt * wp - wt * wtp) / determinant)
                               : Vec3(wp / w - wt / w * ((w * wtp - wt * wp) / least));
  const double share =
      std::min(1.0, w / (whole_weight * area)) * std::min(1.0, determinant / least + smallest);
  return share / (share + bridge * (1 - share));
}

// Blends points with their neighbours by the share that is their own: p[k] becomes
// share p[k] + (1 - share) times the mean of both neighbours, those as they become (a tridiagonal
// system, by Thomas's algorithm). Across a gap this is a straight line.
void bridge_gaps(const std::vector<double> &share, std::vector<Vec3> &points) {
  const size_t count = points.size();
  std::vector<double> ahead(count);
  for (size_t k = 0; k < count; ++k) {
    const bool is_end = k == 0 || k + 1 == count;
    const double beside = (1 - share[k]) * (is_end ? 1.0 : 0.5);
    const double back = k > 0 ? beside : 0.0, front = k + 1 < count ? beside : 0.0;
    const double pivot = 1 - (k > 0 ? back * ahead[k - 1] : 0.0);
    ahead[k] = front / pivot;
    points[k] *= share[k] / pivot;
    if (k > 0) points[k] += back / pivot * points[k - 1];
  }
  for (size_t k = count - 1; k-- > 0;) points[k] += ahead[k] * points[k + 1];
}

}  // namespace

PieceCurve fit_curve(const std::vector<OrderedPiece> &pieces, const OrderSpan &span) {
  const double from = span.from, range = span.length();
  double area = 0;
  for (const OrderedPiece &piece : pieces) area += piece.area;
  PieceCurve curve;
  std::vector<double> share;
  bool has_gaps = false;
  for (int k = 0; k <= steps; ++k) {
    const double at = from + range * k / steps;
    Vec3 point = Vec3::Zero();
    share.push_back(regress(pieces, area, at, window * range, point));
    has_gaps |= share.back() < 1;
    curve.points.push_back(point);
    curve.order.push_back(at);
  }
  if (has_gaps) bridge_gaps(share, curve.points);
  for (size_t k = 0; k < curve.points.size(); ++k) {
    const double step = k > 0 ? (curve.points[k] - curve.points[k - 1]).norm() : 0;
    curve.start.push_back(k > 0 ? curve.start.back() + step : 0);
  }
  return curve;
}

ListPlace find_place(const std::vector<double> &rising, double t, size_t &k) {
  while (k + 2 < rising.size() && rising[k + 1] <= t) ++k;
  while (k > 0 && rising[k] > t) --k;
  const double step = rising[k + 1] - rising[k];
  return {k, step > 0 ? std::clamp((t - rising[k]) / step, 0.0, 1.0) : 0.0};
}

Vec3 point_at(const std::vector<Vec3> &points, const ListPlace &place) {
  return points[place.k] + place.share * (points[place.k + 1] - points[place.k]);
}

}  // namespace mvs::core
