// Matching of the feet of both leaflets, the coaptation line by bisection, closed places.
#include "patient/chordae/closed_target.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"

namespace mvs::core {
namespace {

// Stretch of a loaded leaflet from annulus to free edge, sag of its belly below the straight line
// as a share of its length, width of the line as a share of the annulus: as of the healthy
// parametric valve, which seals with every law (anatomy/PARAMETRIC.md).
constexpr double loaded_stretch = 1.1, belly_sag = 0.07, line_span = 0.95;
// Depth of the line in AP diameters: 5.0 +- 0.7 mm of 26 mm in healthy adults; tethered valves tent
// by up to 10 mm. Share of the way from posterior to anterior annulus.
constexpr double least_line_depth = 0.15, most_line_depth = 0.4;
constexpr double least_balance = 0.1, most_balance = 0.6;
// The line lies at most this share of the loaded height below the annulus, so that leaflets that
// are low near the commissures still overlap.
constexpr double most_drop = 0.6;
constexpr size_t line_stations = 41;  // along the line, about 1 mm apart
constexpr size_t profile_feet = 160;  // of the profile, and along each leaflet
constexpr size_t bisections = 50;

// The feet of one leaflet over the place between the commissures: 0 at the anterolateral one, 1 at
// the posteromedial one.
class FootOfPlace {
 public:
  FootOfPlace(const AnnulusFrame &frame, const AnnulusCurve &annulus, double from, double way)
      : from_(from), way_(way), place_{0} {
    // where the annulus turns back, places go on with this share of the mean
    constexpr double least_rise = 0.15;
    for (size_t k = 0; k < profile_feet; ++k) {
      const double rise =
          frame.local(annulus.at(foot(k + 1)))[0] - frame.local(annulus.at(foot(k)))[0];
      place_.push_back(place_.back() + std::max(rise, least_rise * frame.width / profile_feet));
    }
    for (double &p : place_) p /= place_.back();
  }

  double foot_at(double place) const {
    const auto above = std::upper_bound(place_.begin() + 1, place_.end() - 1, place);
    const size_t k = static_cast<size_t>(above - place_.begin()) - 1;
    return foot(static_cast<double>(k) + (place - place_[k]) / (place_[k + 1] - place_[k]));
  }
  // The foot must be of this leaflet, `along` its way from the anterolateral commissure, m.
  double place_at(double along) const {
    const double at = std::clamp(along / std::abs(way_), 0.0, 1.0) * profile_feet;
    const size_t k = std::min(profile_feet - 1, static_cast<size_t>(at));
    return place_[k] + (at - static_cast<double>(k)) * (place_[k + 1] - place_[k]);
  }

 private:
  template <typename Number>
  double foot(Number k) const {
    return from_ + way_ * static_cast<double>(k) / profile_feet;
  }

  double from_, way_;
  std::vector<double> place_;
};

// Both leaflets at one station, in the frame of the annulus.
struct Opposite {
  Vec3 anterior, posterior;                  // annulus
  double anterior_height, posterior_height;  // m, loaded
};

double profile_at(const std::vector<double> &profile, double foot, double length) {
  const double n = static_cast<double>(profile.size());
  const double at = wrapped(foot / length * n - 0.5, n);
  const size_t k = static_cast<size_t>(at) % profile.size();
  return profile[k] + (at - std::floor(at)) * (profile[(k + 1) % profile.size()] - profile[k]);
}

Vec3 line_point(const Opposite &o, const AnnulusFrame &frame, double share, double depth) {
  Vec3 p = o.posterior + share * (o.anterior - o.posterior);
  p[0] = frame.middle + line_span * (p[0] - frame.middle);
  const double rim = std::min(o.anterior[2], o.posterior[2]);
  const double height = 0.5 * (o.anterior_height + o.posterior_height);
  p[2] = std::clamp(-depth, rim - most_drop * height, rim - 0.1 * height);
  return p;
}

struct Overlaps {
  double anterior, posterior;
};
Overlaps overlaps_at(const Opposite &o, const Vec3 &line) {
  return {o.anterior_height - (line - o.anterior).norm(),
          o.posterior_height - (line - o.posterior).norm()};
}

double balanced_share(const Opposite &o, const AnnulusFrame &frame, double depth) {
  double low = least_balance, high = most_balance;
  for (size_t i = 0; i < bisections; ++i) {
    const double share = 0.5 * (low + high);
    const auto [anterior, posterior] = overlaps_at(o, line_point(o, frame, share, depth));
    (anterior < posterior ? low : high) = share;
  }
  return 0.5 * (low + high);
}

// Shares along the line, each the mean over its neighbours within a tenth of the line, which count
// by the distance of the leaflets: near the commissures every share is balanced.
std::vector<double> shares_along(const std::vector<Opposite> &opposite, const AnnulusFrame &frame,
                                 double depth) {
  constexpr int reach = static_cast<int>(line_stations / 10);
  const int n = static_cast<int>(opposite.size());
  std::vector<double> raw, apart, shares;
  for (const Opposite &o : opposite) {
    raw.push_back(balanced_share(o, frame, depth));
    apart.push_back((o.anterior - o.posterior).norm() + 1e-3 * frame.diameter);
  }
  for (int k = 0; k < n; ++k) {
    double sum = 0, weight = 0;
    for (int j = std::max(0, k - reach); j <= std::min(n - 1, k + reach); ++j) {
      const size_t at = static_cast<size_t>(j);
      sum += apart[at] * raw[at];
      weight += apart[at];
    }
    shares.push_back(sum / weight);
  }
  return shares;
}

struct Line {
  std::vector<Vec3> points;  // of each station, in the frame
  double overlap = 0;        // m, in the middle
};
Line line_of(const std::vector<Opposite> &opposite, const AnnulusFrame &frame, double depth) {
  const std::vector<double> shares = shares_along(opposite, frame, depth);
  Line line;
  // A2 meets P2 over the middle third; a fifth leaves out its borders
  constexpr size_t first = 2 * line_stations / 5, last = line_stations - first;
  for (size_t k = 0; k < opposite.size(); ++k) {
    line.points.push_back(line_point(opposite[k], frame, shares[k], depth));
    if (k < first || k >= last) continue;
    const auto [anterior, posterior] = overlaps_at(opposite[k], line.points[k]);
    line.overlap += 0.5 * (anterior + posterior) / static_cast<double>(last - first);
  }
  return line;
}

// Place of a vertex `run`, m, from the annulus along the closed leaflet: along the sagging way to
// the line, then down.
Vec3 closed_place(const Vec3 &base, const Vec3 &line, double run) {
  const double reach = (line - base).norm();
  if (run >= reach) return line - Vec3(0, 0, run - reach);
  const double u = run / reach;
  return base + u * (line - base) - Vec3(0, 0, belly_sag * reach * 4 * u * (1 - u));
}

}  // namespace

ClosedTarget closed_target(const PatientGeometry &g, const AnnulusCurve &boundary,
                           double coaptation_length) {
  MVS_MUST(coaptation_length >= 1e-3 && coaptation_length <= 20e-3, MVS_E_ARGUMENT,
           "coaptation_length", "coaptation_length is %g mm: it has to be 1 to 20 mm",
           coaptation_length * 1e3);
  const AnnulusFrame frame = annulus_frame(g, boundary);
  const double length = boundary.length(), arc = g.arcs.to - g.arcs.from;
  const FootOfPlace anterior(frame, boundary, g.arcs.to, -arc);
  const FootOfPlace posterior(frame, boundary, g.arcs.to, length - arc);
  const std::vector<double> profile = height_profile(g.rims, g.coordinates, profile_feet);
  std::vector<Opposite> opposite;
  for (size_t k = 0; k < line_stations; ++k) {
    const double place = static_cast<double>(k) / (line_stations - 1);
    const double a = anterior.foot_at(place), p = posterior.foot_at(place);
    opposite.push_back({frame.local(boundary.at(a)), frame.local(boundary.at(p)),
                        loaded_stretch * profile_at(profile, a, length),
                        loaded_stretch * profile_at(profile, p, length)});
  }
  // a deeper line leaves less overlap
  double low = least_line_depth * frame.diameter, high = most_line_depth * frame.diameter;
  for (size_t i = 0; i < bisections; ++i) {
    const double depth = 0.5 * (low + high);
    (line_of(opposite, frame, depth).overlap > coaptation_length ? low : high) = depth;
  }
  ClosedTarget target;
  target.depth = 0.5 * (low + high);
  const Line line = line_of(opposite, frame, target.depth);
  target.overlap = line.overlap;
  for (size_t i = 0; i < g.sheet.x.size(); ++i) {
    const double foot = g.coordinates.foot[i], along = wrapped(g.arcs.to - foot, length);
    const double place =
        along < arc ? anterior.place_at(along) : posterior.place_at(wrapped(-along, length));
    const double at = place * (line_stations - 1);
    const size_t k = std::min(line_stations - 2, static_cast<size_t>(at));
    const Vec3 on_line =
        line.points[k] + (at - static_cast<double>(k)) * (line.points[k + 1] - line.points[k]);
    const Vec3 base = frame.local(boundary.at(foot));
    target.x.push_back(
        frame.global(closed_place(base, on_line, loaded_stretch * g.coordinates.height[i])));
  }
  return target;
}

}  // namespace mvs::core
