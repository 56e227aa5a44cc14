// Local linear regression over the parameter of the pieces, between quantiles of their area.
#include "measure/coaptation/piece_curve.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "base/simd.h"

namespace mvs::core {
namespace {

constexpr double trimmed = 0.005;  // of the area, at either end
constexpr double window = 0.125;   // half width of the regression, share of the line
constexpr int steps = 32;
// Each piece spreads over this angle to both sides when the ends of the line are looked for: a
// piece that passes an end is left out gradually.
constexpr double spread = 0.005;

// The share of a piece below t, when it is spread.
double share_below(double order, double t) {
  return std::clamp((t - order + spread) / (2 * spread), 0.0, 1.0);
}

bool is_before(const OrderedPiece &l, const OrderedPiece &r) {
  return l.order < r.order;
}

// Stable bucket sort by parameter, with about one piece to a bucket. Most pieces of a bucket are
// few, and sorted by insertion.
void sort_by_order(std::vector<OrderedPiece> &pieces) {
  const auto [low, high] = std::minmax_element(pieces.begin(), pieces.end(), is_before);
  if (low == high || !(low->order < high->order)) return;
  const double first = low->order;
  const double scale = static_cast<double>(pieces.size() - 1) / (high->order - first);
  const auto bucket_of = [&](const OrderedPiece &piece) {
    return static_cast<uint32_t>(
        std::min((piece.order - first) * scale, static_cast<double>(pieces.size() - 1)));
  };
  std::vector<uint32_t> start(pieces.size() + 1, 0);
  for (const OrderedPiece &piece : pieces) ++start[bucket_of(piece) + 1];
  for (size_t k = 0; k < pieces.size(); ++k) start[k + 1] += start[k];
  std::vector<uint32_t> next(start.begin(), start.end() - 1);
  std::vector<OrderedPiece> sorted(pieces.size());
  for (const OrderedPiece &piece : pieces) sorted[next[bucket_of(piece)]++] = piece;
  constexpr std::ptrdiff_t few = 16;
  for (size_t k = 0; k < pieces.size(); ++k) {
    const auto begin = sorted.begin() + start[k], end = sorted.begin() + start[k + 1];
    if (end - begin > few) {
      std::stable_sort(begin, end, is_before);
      continue;
    }
    for (auto i = begin; i < end; ++i) {
      for (auto j = i; j > begin && is_before(*j, *(j - 1)); --j) std::swap(*j, *(j - 1));
    }
  }
  pieces = std::move(sorted);
}

// The parameter below which the given area lies, by bisection of the cumulative distribution of the
// spread pieces, sorted by their order. The last interval, of 4e-7, is interpolated.
double quantile(const std::vector<OrderedPiece> &sorted, double area) {
  std::vector<double> below = {0};
  for (const OrderedPiece &piece : sorted) below.push_back(below.back() + piece.area);
  const auto first_from = [&](double t) {
    return std::partition_point(sorted.begin(), sorted.end(),
                                [&](const OrderedPiece &piece) { return piece.order < t; }) -
           sorted.begin();
  };
  const auto area_below = [&](double t) {
    const auto whole = first_from(t - spread), some = first_from(t + spread);
    double sum = below[static_cast<size_t>(whole)];
    for (auto k = whole; k < some; ++k) {
      const OrderedPiece &piece = sorted[static_cast<size_t>(k)];
      sum += piece.area * share_below(piece.order, t);
    }
    return sum;
  };
  double low = -4, high = 4, low_area = 0, high_area = below.back();
  for (int k = 0; k < 24; ++k) {
    const double middle = 0.5 * (low + high), found = area_below(middle);
    (found < area ? low : high) = middle;
    (found < area ? low_area : high_area) = found;
  }
  const double within = high_area - low_area;
  return within > 0 ? low + (high - low) * (area - low_area) / within : low;
}

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
// biased inwards at the ends. Pieces are sorted. Returns false if no piece is near.
bool regress(const std::vector<OrderedPiece> &pieces, double at, double width, Vec3 &point) {
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
  if (w == 0) return false;
  const double determinant = w * wtt - wt * wt;
  const bool spans_a_range = determinant > 1e-6 * w * w;  // else all pieces have one parameter
  point = spans_a_range ? Vec3((wtt * wp - wt * wtp) / determinant) : Vec3(wp / w);
  return true;
}

}  // namespace

OrderSpan trim(std::vector<OrderedPiece> &pieces) {
  sort_by_order(pieces);
  double total = 0;
  for (const OrderedPiece &piece : pieces) total += piece.area;
  const OrderSpan span{quantile(pieces, trimmed * total), quantile(pieces, (1 - trimmed) * total)};
  for (OrderedPiece &piece : pieces) {
    piece.area *= share_below(piece.order, span.to) - share_below(piece.order, span.from);
  }
  return span;
}

PieceCurve fit_curve(const std::vector<OrderedPiece> &pieces, const OrderSpan &span) {
  const double from = span.from, range = span.length();
  PieceCurve curve;
  for (int k = 0; k <= steps; ++k) {
    const double at = from + range * k / steps;
    Vec3 point;
    if (!regress(pieces, at, window * range, point)) continue;
    const double step = curve.points.empty() ? 0 : (point - curve.points.back()).norm();
    curve.start.push_back(curve.points.empty() ? 0 : curve.start.back() + step);
    curve.points.push_back(point);
    curve.order.push_back(at);
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
