// Coaptation line over the angle around a pole, and tissue area per length along it.
#include "measure/coaptation/coaptation_line.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "base/math.h"
#include "base/simd.h"
#include "measure/coaptation/line_ends.h"
#include "measure/coaptation/piece_curve.h"

namespace mvs::core {
namespace {

constexpr double flattest = 0.5;  // sine: slopes below 30 degrees count as 30
constexpr double ends = 0.05;     // share at either end of the line without minimum and maximum
constexpr int profile = 100;      // intervals between the places of a profile

// Distance of each piece from the begin of the curve.
std::vector<double> distances_along(const std::vector<OrderedPiece> &pieces,
                                    const PieceCurve &curve) {
  std::vector<double> distances;
  distances.reserve(pieces.size());
  size_t k = 0;
  for (const OrderedPiece &piece : pieces) {
    const ListPlace place = find_place(curve.order, piece.order, k);
    const double start = curve.start[place.k], end = curve.start[place.k + 1];
    distances.push_back(start + place.share * (end - start));
  }
  return distances;
}

// Distributes the area of each piece linearly to its two nearest stations; assignment to one
// station would show rows of pieces as ripples.
void fill_stations(const std::vector<OrderedPiece> &pieces, const std::vector<double> &along,
                   const PieceCurve &curve, double spacing, CoaptationLine &line) {
  const double length = curve.start.back();
  const int count = static_cast<int>(std::max(1.0, std::round(length / spacing)));
  const double step = count > 1 ? length / count : line.length;
  size_t near = 0;
  for (int k = 0; k < count; ++k) {
    const ListPlace place = find_place(curve.start, (k + 0.5) * length / count, near);
    line.stations.push_back({point_at(curve.points, place), 0});
  }
  for (size_t i = 0; i < pieces.size(); ++i) {
    const OrderedPiece &piece = pieces[i];
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
MVS_INLINE void add_hats(const std::vector<OrderedPiece> &pieces, const std::vector<double> &along,
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

// The coaptation length at places first + k step, smoothed by a hat function as wide as that of the
// stations. The places do not depend on the number of stations.
Profile lengths_along(const std::vector<OrderedPiece> &pieces, const std::vector<double> &along,
                      double length, const std::array<double, 3> &first_step_spacing) {
  static const auto add = simd_kernel<&add_hats<Double2>, &add_hats<Double4>>();
  const auto [first, step, spacing] = first_step_spacing;
  Profile lengths{};
  add(pieces, along, first_step_spacing, lengths);
  for (size_t k = 0; k <= profile; ++k) {
    lengths[k] /= hat_area(first + static_cast<double>(k) * step, spacing, length);
  }
  return lengths;
}

// Looks for the extremes of the coaptation length.
void find_extremes(const std::vector<OrderedPiece> &pieces, const std::vector<double> &along,
                   const PieceCurve &curve, double spacing, CoaptationLine &line) {
  const double length = curve.start.back();
  if (length < 2 * spacing) {  // one place: the mean
    line.shortest = line.longest = line.area / line.length;
    return;
  }
  const double step = (1 - 2 * ends) * length / profile;
  const Profile lengths = lengths_along(pieces, along, length, {ends * length, step, spacing});
  line.shortest = *std::min_element(lengths.begin(), lengths.begin() + profile + 1);
  line.longest = *std::max_element(lengths.begin(), lengths.begin() + profile + 1);
}

// Fills the profile: as the stations, from half a spacing on, but as many places whatever the
// length.
void fill_profile(const std::vector<OrderedPiece> &pieces, const std::vector<double> &along,
                  const PieceCurve &curve, double spacing, CoaptationLine &line) {
  const double length = curve.start.back();
  const double first = std::min(0.5 * spacing, 0.25 * length);
  if (!(length > 0)) return;
  const double step = (length - 2 * first) / profile;
  const Profile lengths = lengths_along(pieces, along, length, {first, step, spacing});
  size_t near = 0;
  for (size_t k = 0; k <= profile; ++k) {
    const double at = first + static_cast<double>(k) * step;
    line.profile.push_back({point_at(curve.points, find_place(curve.start, at, near)), lengths[k]});
  }
}

CoaptationLine area_along(const std::vector<OrderedPiece> &pieces, const PieceCurve &curve,
                          double spacing) {
  CoaptationLine line;
  line.length = std::max(curve.start.back(), spacing);
  for (const OrderedPiece &piece : pieces) line.area += piece.area;
  const std::vector<double> along = distances_along(pieces, curve);
  fill_stations(pieces, along, curve, spacing, line);
  find_extremes(pieces, along, curve, spacing, line);
  fill_profile(pieces, along, curve, spacing, line);
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
  std::vector<OrderedPiece> ordered;
  ordered.reserve(pieces.size());
  for (const CoaptedPiece &piece : pieces) {
    const Vec3 &p = piece.middle;
    ordered.push_back({{p[0], p[1], p[2], 1}, piece.area, angle(p)});
  }
  std::vector<OrderedPiece> rough_pieces = ordered;
  const OrderSpan rough_span = trim(rough_pieces);
  const PieceCurve rough = fit_curve(rough_pieces, rough_span);
  size_t near = 0;
  for (size_t i = 0; i < pieces.size(); ++i) {
    const Vec3 centre = point_at(rough.points, find_place(rough.order, ordered[i].order, near));
    ordered[i].order = angle(slide(pieces[i], axis, (centre - pieces[i].middle).dot(axis)));
  }
  const OrderSpan span = trim(ordered);
  return area_along(ordered, fit_curve(ordered, span), spacing);
}

}  // namespace mvs::core
