// Arc length along the annulus, leaflet attachments and landmarks.
#include "measure/annulus/landmarks.h"

#include <algorithm>
#include <cmath>

namespace mvs::core {

namespace {

std::vector<Vec3> points_at(const std::vector<uint32_t> &nodes, const std::vector<Vec3> &x) {
  std::vector<Vec3> points;
  points.reserve(nodes.size());
  for (const uint32_t node : nodes) points.push_back(x[node]);
  return points;
}

}  // namespace

Loop::Loop(const std::vector<uint32_t> &nodes, const std::vector<Vec3> &x)
    : Loop(points_at(nodes, x)) {}

Loop::Loop(std::vector<Vec3> points) : points_(std::move(points)), start_{0} {
  for (size_t k = 0; k < size(); ++k) {
    start_.push_back(start_.back() + (point(k + 1) - point(k)).norm());
  }
}

Vec3 Loop::at(double s) const {
  s -= length() * std::floor(s / length());
  const auto after = std::upper_bound(start_.begin() + 1, start_.end() - 1, s);
  const size_t edge = static_cast<size_t>(after - start_.begin()) - 1;
  const double along = (s - start_[edge]) / (start_[edge + 1] - start_[edge]);
  return point(edge) + along * (point(edge + 1) - point(edge));
}

double polyline_length(const std::vector<Vec3> &points) {
  double sum = 0;
  for (size_t k = 1; k < points.size(); ++k) sum += (points[k] - points[k - 1]).norm();
  return sum;
}

Vec3 centroid(const Loop &loop) {
  Vec3 sum = Vec3::Zero();
  for (size_t k = 0; k < loop.size(); ++k) {
    const Vec3 &a = loop.point(k), &b = loop.point(k + 1);
    sum += 0.5 * (b - a).norm() * (a + b);
  }
  return sum / loop.length();
}

Mat3 second_moments(const Loop &loop, const Vec3 &about) {
  Mat3 sum = Mat3::Zero();
  for (size_t k = 0; k < loop.size(); ++k) {
    const Vec3 along = loop.point(k + 1) - loop.point(k);
    const Vec3 middle = loop.point(k) + 0.5 * along - about;
    sum += along.norm() * (middle * middle.transpose() + along * along.transpose() / 12.0);
  }
  return sum;
}

std::vector<uint32_t> annulus_triangles(const Model &model) {
  const std::vector<uint32_t> &nodes = model.valve.annulus;
  std::vector<uint32_t> triangles(nodes.size(), none);
  for (size_t k = 0; k < nodes.size(); ++k) {
    const uint32_t e = edge_between(model.topology, nodes[k], nodes[(k + 1) % nodes.size()]);
    if (e != none) triangles[k] = model.topology.edge_triangles[e][0];
  }
  return triangles;
}

Arc attachment(const Model &model, const Loop &annulus, uint32_t leaflet) {
  const std::vector<uint32_t> triangles = annulus_triangles(model);
  const size_t n = triangles.size();
  const auto holds = [&](size_t k) {
    const uint32_t t = triangles[k % n];
    return t != none && model.valve.triangle_leaflet[t] == leaflet;
  };
  Arc longest;
  for (size_t first = 0; first < n; ++first) {
    if (!holds(first) || holds(first + n - 1)) continue;
    size_t last = first;
    while (holds(last)) ++last;
    const double round = last > n ? annulus.length() : 0;
    const Arc arc = {annulus.start_of(first), annulus.start_of(last > n ? last - n : last) + round};
    if (arc.length() > longest.length()) longest = arc;
  }
  return longest;
}

uint32_t anterior_leaflet(const Valve &valve) {
  const auto index_where = [&](auto &&is_it) {
    const auto found = std::find_if(valve.leaflets.begin(), valve.leaflets.end(), is_it);
    return static_cast<uint32_t>(found - valve.leaflets.begin());
  };
  const uint32_t exact = index_where([](const Leaflet &l) { return l.name == "A"; });
  if (exact < valve.leaflets.size()) return exact;
  const uint32_t similar = index_where(
      [](const Leaflet &l) { return !l.name.empty() && (l.name[0] == 'A' || l.name[0] == 'a'); });
  return similar < valve.leaflets.size() ? similar : 0;
}

Arc anterior_stretch(const Model &model, const Loop &annulus) {
  const Arc arc = attachment(model, annulus, anterior_leaflet(model.valve));
  if (arc.length() > 0) return arc;
  return {-0.25 * annulus.length(), 0.25 * annulus.length()};
}

Landmarks find_landmarks(const Model &model, const Loop &annulus) {
  const Arc arc = anterior_stretch(model, annulus);
  return {annulus.at(arc.middle()),
          annulus.at(arc.middle() + 0.5 * annulus.length()),
          {annulus.at(arc.from), annulus.at(arc.to)}};
}

}  // namespace mvs::core
