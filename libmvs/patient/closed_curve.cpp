// Nearest points, unwrapped, and their smooth difference from even places.
#include "patient/closed_curve.h"

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

Vec3 ClosedCurve::at(double s) const {
  const double place = wrapped(s, length());
  const auto after = std::upper_bound(start_.begin() + 1, start_.end() - 1, place);
  const size_t k = static_cast<size_t>(after - start_.begin()) - 1;
  const Vec3 &a = corners_[k], &b = corners_[(k + 1) % corners_.size()];
  const double side = start_[k + 1] - start_[k];
  return side > 0 ? Vec3(a + (place - start_[k]) / side * (b - a)) : a;
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

std::vector<double> places_along(const ClosedCurve &curve, const std::vector<Vec3> &loop) {
  const size_t n = loop.size();
  const ClosedCurve own(loop);
  const double lap = curve.length();
  std::vector<double> even(n), off(n);  // m: evenly, and how far nearest points are beyond that
  double before = 0, place = 0, along = 0;
  for (size_t k = 0; k <= n; ++k) {
    const double here = curve.nearest(loop[k % n]);
    place = k == 0 ? here : place + around(before, here, lap);
    before = here;
    if (k == n) break;
    even[k] = along / own.length() * lap;
    off[k] = place - even[k];
    along += (loop[(k + 1) % n] - loop[k]).norm();
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
