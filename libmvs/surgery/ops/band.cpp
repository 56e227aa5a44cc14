// Operation band: shortens the posterior annulus between the trigones by a flexible band.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.h"
#include "base/math.h"
#include "measure/annulus/frame.h"
#include "measure/annulus/landmarks.h"
#include "surgery/surgery.h"

namespace mvs::core {
namespace {

// Angle of the fibrous trigones from the A point about the axis of the valve
// (libmvs/anatomy/PARAMETRIC.md).
constexpr double trigone = 38 * std::numbers::pi / 180;

// Returns the angles of the annulus nodes about the axis from the A point, -pi to pi.
std::vector<double> angles_from_a(const Model &model, const std::vector<Vec3> &x) {
  const Frame frame = valve_frame(model, x);
  const auto angle = [&](const Vec3 &p) {
    const Vec3 local = frame.local(p);
    return math::atan2(local[1], local[0]);
  };
  const double a = angle(find_landmarks(model, Loop(model.valve.annulus, x)).a);
  std::vector<double> angles;
  for (const uint32_t node : model.valve.annulus.get()) {
    angles.push_back(std::remainder(angle(x[node]) - a, 2 * std::numbers::pi));
  }
  return angles;
}

size_t nearest(const std::vector<double> &angles, double wanted) {
  const auto closer = [=](double l, double r) {
    return std::abs(l - wanted) < std::abs(r - wanted);
  };
  return static_cast<size_t>(std::min_element(angles.begin(), angles.end(), closer) -
                             angles.begin());
}

// Returns the annulus nodes from one trigone along the posterior annulus to the other.
std::vector<uint32_t> posterior_part(const Surgery &s) {
  const std::vector<uint32_t> &annulus = s.before.valve.annulus;
  const std::vector<double> angles = angles_from_a(s.before, s.before.valve.loaded);
  const size_t n = annulus.size(), middle = nearest(angles, 0);
  size_t first = nearest(angles, trigone), last = nearest(angles, -trigone);
  // the direction from first to last over the A point is the anterior one
  if ((middle + n - first) % n <= (last + n - first) % n) std::swap(first, last);
  std::vector<uint32_t> nodes;
  for (size_t k = first; k != last; k = (k + 1) % n) nodes.push_back(annulus[k]);
  nodes.push_back(annulus[last]);
  MVS_MUST(nodes.size() >= 4 && nodes.size() < n, MVS_E_OP, "annulus",
           "band: the annulus has too few nodes between the trigones to take a band: %zu",
           nodes.size());
  return nodes;
}

// Returns points at the same shares of length on the line between the ends.
std::vector<Vec3> straightened(const std::vector<Vec3> &points) {
  const double length = polyline_length(points);
  std::vector<Vec3> line = points;
  double along = 0;
  for (size_t k = 1; k < points.size(); ++k) {
    along += (points[k] - points[k - 1]).norm();
    line[k] = points.front() + along / length * (points.back() - points.front());
  }
  line.back() = points.back();
  return line;
}

std::vector<Vec3> between(const std::vector<Vec3> &line, const std::vector<Vec3> &points,
                          double share) {
  std::vector<Vec3> mixed = line;
  for (size_t k = 0; k < line.size(); ++k) mixed[k] += share * (points[k] - line[k]);
  return mixed;
}

// Blends towards the straight line by bisection until the curve has this length, which is convex in
// the share, least at 0 and increasing.
std::vector<Vec3> shortened(const std::vector<Vec3> &points, double length) {
  const std::vector<Vec3> line = straightened(points);
  double low = 0, high = 1;
  for (int k = 0; k < 60; ++k) {
    const double middle = 0.5 * (low + high);
    (polyline_length(between(line, points, middle)) < length ? low : high) = middle;
  }
  return between(line, points, high);
}

double wanted_length(const mvs_op_band &op, double present, double straight) {
  MVS_MUST((op.length != 0) + (op.factor != 0) == 1, MVS_E_ARGUMENT, "band",
           "band: give either a length or a factor");
  const double length = op.length != 0 ? op.length : op.factor * present;
  MVS_MUST(length <= present, MVS_E_OP, "band",
           "band: it would be %.1f mm long, the posterior annulus is %.1f mm: a band shortens it, "
           "give at most that",
           1e3 * length, 1e3 * present);
  MVS_MUST(length > straight, MVS_E_OP, "band",
           "band: it would be %.1f mm long, but the trigones, which it joins, are %.1f mm apart: "
           "give more than that",
           1e3 * length, 1e3 * straight);
  return length;
}

}  // namespace

void operate(Surgery &s, const mvs_op_band &op) {
  const std::vector<uint32_t> nodes = posterior_part(s);
  std::vector<Vec3> points;
  points.reserve(nodes.size());
  for (const uint32_t node : nodes) points.push_back(s.before.valve.loaded[node]);
  const double present = polyline_length(points);
  const double length = wanted_length(op, present, (points.back() - points.front()).norm());
  std::vector<Vec3> placed = shortened(points, length);
  for (size_t k = 0; k < nodes.size(); ++k) {
    s.valve.open[nodes[k]] += placed[k] - points[k];
    s.valve.loaded[nodes[k]] += placed[k] - points[k];
  }
  set_ring(s, op.name, "band", RingKind::band, std::move(placed));
  s.title = format("Sew in %s, %.1f mm, %.0f %% of the posterior annulus",
                   s.valve.rings.get()[0].name.c_str(), 1e3 * length, 100 * length / present);
}

}  // namespace mvs::core
