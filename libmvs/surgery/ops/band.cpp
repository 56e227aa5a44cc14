// A flexible band is sewn along the posterior annulus.
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

// The fibrous trigones, seen along the valve's axis from the A point (libmvs/anatomy/README.md).
constexpr double trigone = 38 * std::numbers::pi / 180;

// Angles of the annulus nodes about the axis, -pi to pi, from the A point.
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

// From one trigone along the posterior annulus to the other.
std::vector<uint32_t> posterior_part(const Surgery &s) {
  const std::vector<uint32_t> &annulus = s.before.valve.annulus;
  const std::vector<double> angles = angles_from_a(s.before, s.before.valve.loaded);
  const size_t n = annulus.size(), middle = nearest(angles, 0);
  size_t first = nearest(angles, trigone), last = nearest(angles, -trigone);
  // the way from first to last that leads past the A point is the anterior one
  if ((middle + n - first) % n <= (last + n - first) % n) std::swap(first, last);
  std::vector<uint32_t> nodes;
  for (size_t k = first; k != last; k = (k + 1) % n) nodes.push_back(annulus[k]);
  nodes.push_back(annulus[last]);
  MVS_MUST(nodes.size() >= 4 && nodes.size() < n, MVS_E_OP, "annulus",
           "band: the annulus has too few nodes between the trigones to take a band: %zu",
           nodes.size());
  return nodes;
}

double length_of(const std::vector<Vec3> &points) {
  double sum = 0;
  for (size_t k = 1; k < points.size(); ++k) sum += (points[k] - points[k - 1]).norm();
  return sum;
}

// Points at the same shares of length on the line between the ends.
std::vector<Vec3> straightened(const std::vector<Vec3> &points) {
  const double length = length_of(points);
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

// The length of `between` is convex in the share and least at 0, so it grows from there to 1 and
// halving finds every length between.
std::vector<Vec3> shortened(const std::vector<Vec3> &points, double length) {
  const std::vector<Vec3> line = straightened(points);
  double low = 0, high = 1;
  for (int k = 0; k < 60; ++k) {
    const double middle = 0.5 * (low + high);
    (length_of(between(line, points, middle)) < length ? low : high) = middle;
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
  const double present = length_of(points);
  const double length = wanted_length(op, present, (points.back() - points.front()).norm());
  std::vector<Vec3> placed = shortened(points, length);
  for (size_t k = 0; k < nodes.size(); ++k) {
    s.valve.open[nodes[k]] += placed[k] - points[k];
    s.valve.loaded[nodes[k]] += placed[k] - points[k];
  }
  Ring part;
  part.id = s.made = s.new_id();
  part.name = op.name && *op.name ? op.name : "band";
  part.kind = MVS_RING_KIND_BAND;
  part.curve = std::move(placed);
  s.title = format("Sew in %s, %.1f mm, %.0f %% of the posterior annulus", part.name.c_str(),
                   1e3 * length, 100 * length / present);
  s.valve.rings = {std::move(part)};
}

}  // namespace mvs::core
