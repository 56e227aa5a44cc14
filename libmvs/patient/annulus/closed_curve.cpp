// Nearest points, unwrapped, and their smooth difference from even places.
#include "patient/annulus/closed_curve.h"

#include <algorithm>
#include <cmath>

#include "geometry/distance.h"
#include "patient/coordinates.h"

namespace mvs::core {
namespace {

// Share of a lap over which differences from even places are averaged, on both sides.
constexpr double averaging_share = 0.125;

}  // namespace

ClosedCurve::ClosedCurve(std::vector<Vec3> corners) : corners_(std::move(corners)), start_{0} {
  for (size_t k = 0; k < corners_.size(); ++k) {
    start_.push_back(start_.back() + (corners_[(k + 1) % corners_.size()] - corners_[k]).norm());
  }
}

ClosedCurve::OnSide ClosedCurve::locate(double s) const {
  const double in = wrapped(s, length());
  const auto after = std::upper_bound(start_.begin() + 1, start_.end() - 1, in);
  const size_t k = static_cast<size_t>(after - start_.begin()) - 1;
  const double span = start_[k + 1] - start_[k];
  return {k, span > 0 ? std::clamp((in - start_[k]) / span, 0.0, 1.0) : 0.0};
}

Vec3 ClosedCurve::at(double s) const {
  const OnSide on = locate(s);
  return (1 - on.share) * corners_[on.side] + on.share * corners_[(on.side + 1) % size()];
}

double ClosedCurve::nearest(const Vec3 &p) const {
  double best = 0, least = HUGE_VAL;
  for (size_t k = 0; k < corners_.size(); ++k) {
    const SegmentPoint on = closest_on_segment(p, corners_[k], corners_[(k + 1) % corners_.size()]);
    if (on.distance2 >= least) continue;
    least = on.distance2;
    best = start_[k] + on.s * (start_[k + 1] - start_[k]);
  }
  return wrapped(best, length());
}

ClosedCurve ClosedCurve::reversed() const {
  return ClosedCurve({corners_.rbegin(), corners_.rend()});
}

std::vector<Vec3> points_along(const std::vector<uint32_t> &loop, const std::vector<Vec3> &x) {
  std::vector<Vec3> points;
  points.reserve(loop.size());
  for (const uint32_t i : loop) points.push_back(x[i]);
  return points;
}

std::vector<double> places_along(const ClosedCurve &curve, const std::vector<Vec3> &loop) {
  const size_t n = loop.size();
  const ClosedCurve own(loop);
  const double lap = curve.length();
  std::vector<double> even(n), off(n);  // m: evenly, and how far nearest points are beyond that
  double before = 0, place = 0;
  for (size_t k = 0; k <= n; ++k) {
    const double here = curve.nearest(loop[k % n]);
    place = k == 0 ? here : place + around(before, here, lap);
    before = here;
    if (k == n) break;
    even[k] = own.start_of(k) / own.length() * lap;
    off[k] = place - even[k];
  }
  const double laps = (place - off[0]) / lap;
  if (!(laps > 0.5 && laps < 1.5)) return {};
  std::vector<double> places(n);
  for (size_t k = 0; k < n; ++k) {
    double sum = 0, weight = 0;
    for (size_t j = 0; j < n; ++j) {
      const double away = std::abs(around(even[k], even[j], lap)) / (averaging_share * lap);
      if (away >= 1) continue;
      sum += (1 - away) * off[j];
      weight += 1 - away;
    }
    places[k] = even[k] + sum / weight;
  }
  for (size_t k = 0; k < n; ++k) {
    const double next = k + 1 < n ? places[k + 1] : places[0] + lap;
    if (next <= places[k]) return {};
  }
  return places;
}

}  // namespace mvs::core
