// Plication of the annulus between the commissures: the curve is drawn towards the line between
// them, and its nodes are redistributed so that only the gathered stretch has shorter edges.
#include "surgery/cutting/plicate.h"

#include <numbers>

#include "base/error.h"
#include "base/math.h"
#include "measure/annulus/landmarks.h"

namespace mvs::core {
namespace {

// Least length of an annulus edge, as a share: an edge cannot vanish, as the tissue above it needs
// a place.
constexpr double shortest = 0.25;

// The gathered part of the annulus with the length factor of each edge.
struct Stretch {
  std::vector<uint32_t> nodes;  // from one commissure to the other
  std::vector<double> factor;   // per edge, times its length
};

// Length factor of an edge for a dip of the form cos^2 with half width w = width / (1 - shortest),
// whose integral is the width.
double shortened(double from, double to, double width) {
  const double w = width / (1 - shortest);
  const auto taken = [&](double s) {
    const double u = std::clamp(s / w, -1.0, 1.0);
    return (1 - shortest) * w * 0.5 * (u + math::sin(std::numbers::pi * u) / std::numbers::pi);
  };
  return 1 - (taken(to) - taken(from)) / (to - from);
}

// The annulus by arc length from the commissure at the end of the anterior leaflet.
class Walk {
 public:
  explicit Walk(const Surgery &s) : loop_(s.valve.annulus, s.valve.rest) {
    Arc fixed = attachment(s.before, loop_, anterior_leaflet(s.valve));
    if (fixed.length() == 0) fixed = {-0.25 * loop_.length(), 0.25 * loop_.length()};
    length_ = after(fixed.from - fixed.to);
    for (size_t k = 1; k < loop_.size(); ++k) {
      if (from(fixed.to, k) < from(fixed.to, first_)) first_ = k;
    }
  }

  double length() const { return length_; }  // of the posterior annulus
  size_t size() const { return loop_.size(); }
  size_t node(size_t k) const { return (first_ + k) % loop_.size(); }
  double arc(size_t k) const { return from(loop_.start_of(first_), node(k)); }

  double arc_nearest(const Vec3 &at) const {
    size_t nearest = 0;
    for (size_t k = 1; k < size(); ++k) {
      if ((point(k) - at).norm() < (point(nearest) - at).norm()) nearest = k;
    }
    return arc(nearest);
  }

 private:
  const Vec3 &point(size_t k) const { return loop_.point(node(k)); }
  double after(double arc) const { return arc - loop_.length() * std::floor(arc / loop_.length()); }
  // rounding must not move the commissure by a full turn
  double from(double start, size_t k) const { return after(loop_.start_of(k) - start + rounding); }
  static constexpr double rounding = 1e-9;

  Loop loop_;
  double length_ = 0;
  size_t first_ = 0;
};

Stretch stretch_around(const Surgery &s, const Vec3 &at, double width) {
  const Walk walk(s);
  const double middle = walk.arc_nearest(at);
  MVS_MUST(
      middle - 0.5 * width > 0 && middle + 0.5 * width < walk.length(), MVS_E_OP, "annulus",
      "%s: the annulus of the anterior leaflet belongs to the skeleton of the heart and cannot "
      "be gathered by %.1f mm: cut a triangle, or stay between the commissures of the "
      "posterior leaflet",
      s.op_name, 1e3 * width);
  const std::vector<uint32_t> &annulus = s.valve.annulus;
  Stretch stretch{{annulus[walk.node(0)]}, {}};
  for (size_t k = 1; k < walk.size() && walk.arc(k - 1) < walk.length() - 1e-8; ++k) {
    stretch.nodes.push_back(annulus[walk.node(k)]);
    stretch.factor.push_back(shortened(walk.arc(k - 1) - middle, walk.arc(k) - middle, width));
  }
  return stretch;
}

// Returns a curve drawn towards the line between its ends.
std::vector<Vec3> drawn(const std::vector<Vec3> &curve, double share) {
  const Vec3 &from = curve.front();
  const Vec3 chord = curve.back() - from;
  std::vector<Vec3> out;
  for (const Vec3 &p : curve) {
    const Vec3 foot = from + (p - from).dot(chord) / chord.squaredNorm() * chord;
    out.push_back(foot + share * (p - foot));
  }
  return out;
}

// Positions the nodes of the stretch: each edge gets its share of the remaining length.
void gather(const Surgery &s, const Stretch &stretch, CowVector<Vec3> &places) {
  std::vector<Vec3> curve;
  for (const uint32_t node : stretch.nodes) curve.push_back(places.get()[node]);
  std::vector<double> arc = {0};
  for (size_t k = 0; k + 1 < curve.size(); ++k) {
    arc.push_back(arc.back() + stretch.factor[k] * (curve[k + 1] - curve[k]).norm());
  }
  MVS_MUST(arc.back() > 1.02 * (curve.back() - curve.front()).norm(), MVS_E_OP, "annulus",
           "%s: the annulus would become straight from commissure to commissure: take a smaller "
           "base_width",
           s.op_name);
  double low = 0, high = 1;
  for (int k = 0; k < 60; ++k) {
    const double share = 0.5 * (low + high);
    (polyline_length(drawn(curve, share)) < arc.back() ? low : high) = share;
  }
  const std::vector<Vec3> target = drawn(curve, high);
  double start = 0;
  for (size_t k = 1, edge = 0; k + 1 < curve.size(); ++k) {
    double side = (target[edge + 1] - target[edge]).norm();
    while (start + side < arc[k] && edge + 2 < target.size()) {
      start += side;
      ++edge;
      side = (target[edge + 1] - target[edge]).norm();
    }
    places[stretch.nodes[k]] =
        target[edge] + (arc[k] - start) / side * (target[edge + 1] - target[edge]);
  }
}

}  // namespace

void plicate(Surgery &s, const Vec3 &at, double width) {
  must_have_no_ring(s, "which a quadrangle has to gather: resect first, or cut a triangle");
  const Stretch stretch = stretch_around(s, at, width);
  gather(s, stretch, s.valve.open);
  gather(s, stretch, s.valve.loaded);
}

}  // namespace mvs::core
