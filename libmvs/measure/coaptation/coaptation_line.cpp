// Coaptation line by local linear regression over the angle around a pole, and tissue area per
// length along it.
#include "measure/coaptation/coaptation_line.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>

#include "base/math.h"
#include "base/simd.h"

namespace mvs::core {
namespace {

constexpr double trimmed = 0.005;  // of the area, at either end
constexpr double window = 0.125;   // half width of the regression, share of the line
constexpr int steps = 32;
constexpr double flattest = 0.5;  // sine: slopes below 30 degrees count as 30
// Each piece spreads over this angle to both sides when the ends of the line are looked for: a
// piece that passes an end is left out gradually.
constexpr double spread = 0.005;
constexpr double ends = 0.05;  // share at either end of the line without minimum and maximum
constexpr int profile = 100;   // intervals between the places where these are looked for

// A piece with a parameter that increases along the line.
struct Ordered {
  std::array<double, 4> middle_and_one;  // for registers
  double area, order;
};

// The interval of the parameter that holds the area between two quantiles.
struct Span {
  double from, to;
  double length() const { return to - from; }
};

// The share of a piece below t, when it is spread.
double share_below(double order, double t) {
  return std::clamp((t - order + spread) / (2 * spread), 0.0, 1.0);
}

bool is_before(const Ordered &l, const Ordered &r) {
  return l.order < r.order;
}

// Stable bucket sort by parameter, with about one piece to a bucket. Most pieces of a bucket are
// few, and sorted by insertion.
void sort_by_order(std::vector<Ordered> &pieces) {
  const auto [low, high] = std::minmax_element(pieces.begin(), pieces.end(), is_before);
  if (low == high || !(low->order < high->order)) return;
  const double first = low->order;
  const double scale = static_cast<double>(pieces.size() - 1) / (high->order - first);
  const auto bucket_of = [&](const Ordered &piece) {
    return static_cast<uint32_t>(
        std::min((piece.order - first) * scale, static_cast<double>(pieces.size() - 1)));
  };
  std::vector<uint32_t> start(pieces.size() + 1, 0);
  for (const Ordered &piece : pieces) ++start[bucket_of(piece) + 1];
  for (size_t k = 0; k < pieces.size(); ++k) start[k + 1] += start[k];
  std::vector<uint32_t> next(start.begin(), start.end() - 1);
  std::vector<Ordered> sorted(pieces.size());
  for (const Ordered &piece : pieces) sorted[next[bucket_of(piece)]++] = piece;
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
double quantile(const std::vector<Ordered> &sorted, double area) {
  std::vector<double> below = {0};
  for (const Ordered &piece : sorted) below.push_back(below.back() + piece.area);
  const auto first_from = [&](double t) {
    return std::partition_point(sorted.begin(), sorted.end(),
                                [&](const Ordered &piece) { return piece.order < t; }) -
           sorted.begin();
  };
  const auto area_below = [&](double t) {
    const auto whole = first_from(t - spread), some = first_from(t + spread);
    double sum = below[static_cast<size_t>(whole)];
    for (auto k = whole; k < some; ++k) {
      const Ordered &piece = sorted[static_cast<size_t>(k)];
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

// Sorts pieces by parameter and removes the outermost share of their area; returns where the rest
// begins and ends.
Span trim(std::vector<Ordered> &pieces) {
  sort_by_order(pieces);
  double total = 0;
  for (const Ordered &piece : pieces) total += piece.area;
  const Span span{quantile(pieces, trimmed * total), quantile(pieces, (1 - trimmed) * total)};
  for (Ordered &piece : pieces) {
    piece.area *= share_below(piece.order, span.to) - share_below(piece.order, span.from);
  }
  return span;
}

// A polygon with the parameter and the arc length at each point.
struct Curve {
  std::vector<Vec3> points;
  std::vector<double> order, start;
};

// Weighted sums over pieces: of 1, t, t^2, and of the middles times 1 and t.
struct Moments {
  std::array<double, 4> one{}, t{};  // of the middle and of 1
  double tt = 0;
};

// Sums the pieces within a width of a parameter; t is the distance from it over the width. The
// elements of a register are coordinates of one piece, so that every sum is in the order of pieces.
template <typename V>
MVS_INLINE void sum_moments(std::span<const Ordered> pieces, double at, double width,
                            Moments &moments) {
  using Value = typename V::Value;
  constexpr size_t registers = 4 / V::width;
  Value one[registers] = {}, with_t[registers] = {};
  double tt = 0;
  for (const Ordered &piece : pieces) {
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
bool regress(const std::vector<Ordered> &pieces, double at, double width, Vec3 &point) {
  static const auto sum = simd_kernel<&sum_moments<Double2>, &sum_moments<Double4>>();
  const auto first = std::partition_point(
      pieces.begin(), pieces.end(), [&](const Ordered &piece) { return piece.order < at - width; });
  const auto end = std::partition_point(
      first, pieces.end(), [&](const Ordered &piece) { return piece.order <= at + width; });
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

Curve fit_curve(const std::vector<Ordered> &pieces, const Span &span) {
  const double from = span.from, range = span.length();
  Curve curve;
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

// The interval of an ascending list that contains t, and the position in it.
struct Place {
  size_t k;
  double share;
};
// `k`: an interval near that of t, from which the search walks to it.
Place find_place(const std::vector<double> &rising, double t, size_t &k) {
  while (k + 2 < rising.size() && rising[k + 1] <= t) ++k;
  while (k > 0 && rising[k] > t) --k;
  const double step = rising[k + 1] - rising[k];
  return {k, step > 0 ? std::clamp((t - rising[k]) / step, 0.0, 1.0) : 0.0};
}

Vec3 point_at(const std::vector<Vec3> &points, const Place &place) {
  return points[place.k] + place.share * (points[place.k + 1] - points[place.k]);
}

// Distance of each piece from the begin of the curve.
std::vector<double> distances_along(const std::vector<Ordered> &pieces, const Curve &curve) {
  std::vector<double> distances;
  distances.reserve(pieces.size());
  size_t k = 0;
  for (const Ordered &piece : pieces) {
    const Place place = find_place(curve.order, piece.order, k);
    const double start = curve.start[place.k], end = curve.start[place.k + 1];
    distances.push_back(start + place.share * (end - start));
  }
  return distances;
}

// Distributes the area of each piece linearly to its two nearest stations; assignment to one
// station would show rows of pieces as ripples.
void fill_stations(const std::vector<Ordered> &pieces, const std::vector<double> &along,
                   const Curve &curve, double spacing, CoaptationLine &line) {
  const double length = curve.start.back();
  const int count = static_cast<int>(std::max(1.0, std::round(length / spacing)));
  const double step = count > 1 ? length / count : line.length;
  size_t near = 0;
  for (int k = 0; k < count; ++k) {
    const Place place = find_place(curve.start, (k + 0.5) * length / count, near);
    line.stations.push_back({point_at(curve.points, place), 0});
  }
  for (size_t i = 0; i < pieces.size(); ++i) {
    const Ordered &piece = pieces[i];
    const double place = std::clamp(along[i] / step - 0.5, 0.0, count - 1.0);
    const size_t before = static_cast<size_t>(place);
    const size_t after = std::min(before + 1, line.stations.size() - 1);
    const double share = place - static_cast<double>(before);
    line.stations[before].length += (1 - share) * piece.area / step;
    line.stations[after].length += share * piece.area / step;
  }
}

// The area under a hat function of unit height over [at - width, at + width] within [0, length].
double hat_area(double at, double width, double length) {
  const auto side = [&](double room) {
    const double r = std::min(room / width, 1.0);
    return width * r * (1 - 0.5 * r);
  };
  return side(at) + side(length - at);
}

// The places of a profile, and room for a register more.
using Profile = std::array<double, profile + 16>;

// Adds the area of pieces to the places around them, by a hat function. Places are first + k step.
template <typename V>
MVS_INLINE void add_hats(const std::vector<Ordered> &pieces, const std::vector<double> &along,
                         const std::array<double, 3> &first_step_spacing, Profile &sum) {
  using Value = typename V::Value;
  const auto [first, step, spacing] = first_step_spacing;
  const Value zero = {}, one = zero + 1;
  double ramp[V::width];
  for (uint32_t i = 0; i < V::width; ++i) ramp[i] = i;
  Value numbers;
  load<V>(numbers, ramp);
  for (size_t i = 0; i < pieces.size(); ++i) {
    const double t = along[i];
    const double from = std::clamp(std::ceil((t - spacing - first) / step), 0.0, profile + 1.0);
    for (size_t k = static_cast<size_t>(from); k <= profile; k += V::width) {
      const double place = first + static_cast<double>(k) * step;
      if (t < place && (place - t) / spacing >= 1) break;
      const Value off = (zero + (t - first)) - (numbers + static_cast<double>(k)) * step;
      const Value left = one - (off < zero ? -off : off) / spacing;
      Value there;
      load<V>(there, &sum[k]);
      there = there + (zero + pieces[i].area) * (left > zero ? left : zero);
      store<V>(&sum[k], there);
    }
  }
}

// Looks for the extremes of the coaptation length, smoothed by a hat function as wide as that of
// the stations, at places that do not depend on their number.
void find_extremes(const std::vector<Ordered> &pieces, const std::vector<double> &along,
                   const Curve &curve, double spacing, CoaptationLine &line) {
  const double length = curve.start.back();
  if (length < 2 * spacing) {  // one place: the mean
    line.shortest = line.longest = line.area / line.length;
    return;
  }
  static const auto add = simd_kernel<&add_hats<Double2>, &add_hats<Double4>>();
  Profile sum{};
  const double first = ends * length, step = (1 - 2 * ends) * length / profile;
  add(pieces, along, {first, step, spacing}, sum);
  for (size_t k = 0; k <= profile; ++k) {
    const double at = first + static_cast<double>(k) * step;
    const double here = sum[k] / hat_area(at, spacing, length);
    line.shortest = k == 0 ? here : std::min(line.shortest, here);
    line.longest = std::max(line.longest, here);
  }
}

CoaptationLine area_along(const std::vector<Ordered> &pieces, const Curve &curve, double spacing) {
  CoaptationLine line;
  line.length = std::max(curve.start.back(), spacing);
  for (const Ordered &piece : pieces) line.area += piece.area;
  const std::vector<double> along = distances_along(pieces, curve);
  fill_stations(pieces, along, curve, spacing, line);
  find_extremes(pieces, along, curve, spacing, line);
  return line;
}

// Angle around the pole, seen along the axis: it increases along the line, be it straight or a
// horseshoe.
class Angle {
 public:
  Angle(const Vec3 &pole, const Vec3 &axis, const std::vector<CoaptedPiece> &pieces) : pole_(pole) {
    Vec3 mean = Vec3::Zero();
    for (const CoaptedPiece &piece : pieces) mean += piece.area * (piece.middle - pole);
    ahead_ = mean - mean.dot(axis) * axis;
    aside_ = axis.cross(ahead_);
  }
  double operator()(const Vec3 &p) const {
    return math::atan2((p - pole_).dot(aside_), (p - pole_).dot(ahead_));
  }

 private:
  Vec3 pole_, ahead_, aside_;
};

// Moves a piece by `rise` along the steepest slope of its tissue: all tissue along one such slope
// belongs to one point of the line.
Vec3 slide(const CoaptedPiece &piece, const Vec3 &axis, double rise) {
  const double up = piece.normal.dot(axis);
  const Vec3 level = piece.normal - up * axis;
  const double least = flattest * piece.normal.norm();
  return piece.middle + rise * (axis - up / std::max(level.squaredNorm(), least * least) * level);
}

}  // namespace

CoaptationLine find_coaptation_line(const std::vector<CoaptedPiece> &pieces, const Vec3 &pole,
                                    const Vec3 &axis, double spacing) {
  const Angle angle(pole, axis, pieces);
  std::vector<Ordered> ordered;
  ordered.reserve(pieces.size());
  for (const CoaptedPiece &piece : pieces) {
    const Vec3 &p = piece.middle;
    ordered.push_back({{p[0], p[1], p[2], 1}, piece.area, angle(p)});
  }
  std::vector<Ordered> rough_pieces = ordered;
  const Span rough_span = trim(rough_pieces);
  const Curve rough = fit_curve(rough_pieces, rough_span);
  size_t near = 0;
  for (size_t i = 0; i < pieces.size(); ++i) {
    const Vec3 centre = point_at(rough.points, find_place(rough.order, ordered[i].order, near));
    ordered[i].order = angle(slide(pieces[i], axis, (centre - pieces[i].middle).dot(axis)));
  }
  const Span span = trim(ordered);
  return area_along(ordered, fit_curve(ordered, span), spacing);
}

}  // namespace mvs::core
