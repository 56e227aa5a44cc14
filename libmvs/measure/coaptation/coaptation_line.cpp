// Coaptation line by local linear regression over the angle around a pole, and tissue area per
// length along it.
#include "measure/coaptation/coaptation_line.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "base/math.h"

namespace mvs::core {
namespace {

constexpr double trimmed = 0.005;  // of the area, at either end
constexpr double window = 0.125;   // half width of the regression, share of the line
constexpr int steps = 32;
constexpr double flattest = 0.5;  // sine: slopes below 30 degrees count as 30

// A piece with a parameter that increases along the line.
struct Ordered {
  Vec3 middle;
  double area, order;
};

// A polygon with the parameter and the arc length at each point.
struct Curve {
  std::vector<Vec3> points;
  std::vector<double> order, start;
};

// Sorts pieces by parameter and removes the outermost share of their area.
std::vector<Ordered> trim(std::vector<Ordered> pieces) {
  std::stable_sort(pieces.begin(), pieces.end(),
                   [](const Ordered &l, const Ordered &r) { return l.order < r.order; });
  double total = 0, sum = 0;
  for (const Ordered &piece : pieces) total += piece.area;
  std::vector<Ordered> kept;
  for (const Ordered &piece : pieces) {
    const double middle = sum + 0.5 * piece.area;
    if (middle > trimmed * total && middle < (1 - trimmed) * total) kept.push_back(piece);
    sum += piece.area;
  }
  return kept;
}

// Local linear regression (Cleveland, JASA 74, 1979) at one parameter: unlike a mean it is not
// biased inwards at the ends. Returns false if no piece is near.
bool regress(const std::vector<Ordered> &pieces, double at, double width, Vec3 &point) {
  double w = 0, wt = 0, wtt = 0;
  Vec3 wp = Vec3::Zero(), wtp = Vec3::Zero();
  for (const Ordered &piece : pieces) {
    const double t = width > 0 ? (piece.order - at) / width : 0;
    const double weight = piece.area * std::max(0.0, 1 - std::abs(t));
    w += weight;
    wt += weight * t;
    wtt += weight * t * t;
    wp += weight * piece.middle;
    wtp += weight * t * piece.middle;
  }
  if (w == 0) return false;
  const double determinant = w * wtt - wt * wt;
  const bool spans_a_range = determinant > 1e-6 * w * w;  // else all pieces have one parameter
  point = spans_a_range ? Vec3((wtt * wp - wt * wtp) / determinant) : Vec3(wp / w);
  return true;
}

Curve fit_curve(const std::vector<Ordered> &pieces) {
  const double from = pieces.front().order, range = pieces.back().order - from;
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
Place find_place(const std::vector<double> &rising, double t) {
  const auto after = std::upper_bound(rising.begin() + 1, rising.end() - 1, t);
  const size_t k = static_cast<size_t>(after - rising.begin()) - 1;
  const double step = rising[k + 1] - rising[k];
  return {k, step > 0 ? std::clamp((t - rising[k]) / step, 0.0, 1.0) : 0.0};
}

Vec3 point_at(const std::vector<Vec3> &points, const Place &place) {
  return points[place.k] + place.share * (points[place.k + 1] - points[place.k]);
}

// Distributes the area of each piece linearly to its two nearest stations; assignment to one
// station would show rows of pieces as ripples.
CoaptationLine area_along(const std::vector<Ordered> &pieces, const Curve &curve, double spacing) {
  const double length = curve.start.back();
  const int count = static_cast<int>(std::max(1.0, std::round(length / spacing)));
  CoaptationLine line;
  line.spacing = count > 1 ? length / count : std::max(length, spacing);
  for (int k = 0; k < count; ++k) {
    const Place place = find_place(curve.start, (k + 0.5) * length / count);
    line.stations.push_back({point_at(curve.points, place), 0});
  }
  for (const Ordered &piece : pieces) {
    const Place on_curve = find_place(curve.order, piece.order);
    const double start = curve.start[on_curve.k], end = curve.start[on_curve.k + 1];
    const double t = start + on_curve.share * (end - start);
    const double place = std::clamp(t / line.spacing - 0.5, 0.0, count - 1.0);
    const size_t before = static_cast<size_t>(place);
    const size_t after = std::min(before + 1, line.stations.size() - 1);
    const double share = place - static_cast<double>(before);
    line.stations[before].length += (1 - share) * piece.area / line.spacing;
    line.stations[after].length += share * piece.area / line.spacing;
  }
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
    ordered.push_back({piece.middle, piece.area, angle(piece.middle)});
  }
  const Curve rough = fit_curve(trim(ordered));
  for (size_t i = 0; i < pieces.size(); ++i) {
    const Vec3 centre = point_at(rough.points, find_place(rough.order, ordered[i].order));
    ordered[i].order = angle(slide(pieces[i], axis, (centre - pieces[i].middle).dot(axis)));
  }
  ordered = trim(std::move(ordered));
  return area_along(ordered, fit_curve(ordered), spacing);
}

}  // namespace mvs::core
