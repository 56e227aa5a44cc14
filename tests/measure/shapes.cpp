// Meshes of the shapes of tests/measure/shapes.h.
#include "tests/measure/shapes.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>

namespace mvs::core::test {

Valve valve_of(const Sheet &sheet) {
  Valve valve;
  valve.contact_thickness = contact_thickness;
  valve.leaflets.resize(2);
  valve.leaflets[0].name = "A";
  valve.leaflets[1].name = "P";
  const size_t n = sheet.around;
  const auto angle_of = [&](double k) { return 2 * pi * k / static_cast<double>(n); };
  for (size_t r = 0; r <= sheet.rings; ++r) {
    for (size_t k = 0; k < n; ++k) {
      const double s = static_cast<double>(r) / static_cast<double>(sheet.rings);
      valve.rest.push_back(sheet.at(angle_of(static_cast<double>(k)), s));
    }
  }
  for (uint32_t r = 0; r < sheet.rings; ++r) {
    for (uint32_t k = 0; k < n; ++k) {
      const uint32_t next = (k + 1) % static_cast<uint32_t>(n), row = static_cast<uint32_t>(n);
      const uint32_t a = r * row + k, b = r * row + next, c = b + row, d = a + row;
      valve.triangles.push_back({a, b, c});
      valve.triangles.push_back({a, c, d});
      const bool anterior = std::cos(angle_of(k + 0.5)) > std::cos(sheet.anterior);
      valve.triangle_leaflet.insert(valve.triangle_leaflet.end(), 2, anterior ? 0 : 1);
    }
  }
  for (uint32_t k = 0; k < n; ++k) valve.annulus.push_back(k);
  for (const double side : {-1.0, 1.0}) {
    Head head;
    head.node = static_cast<uint32_t>(valve.rest.size());
    valve.heads.push_back(head);
    valve.rest.push_back({0, side * 10e-3, -30e-3});
  }
  valve.loaded = valve.rest;
  return valve;
}

ModelPtr model_of(const Sheet &sheet) {
  return make_model(valve_of(sheet));
}

Sheet disc(double radius, double hole, const std::function<double(double x, double y)> &height) {
  Sheet sheet;
  sheet.at = [=](double angle, double s) -> Vec3 {
    const double r = radius + s * (hole - radius);
    const double x = r * std::cos(angle), y = r * std::sin(angle);
    return {x, y, height(x, y)};
  };
  return sheet;
}

Sheet two_gaps(double left, double right) {
  constexpr double mm = 1e-3;
  Sheet sheet;
  sheet.around = 96;
  sheet.rings = 24;
  sheet.at = [=](double angle, double s) -> Vec3 {
    const double c = std::cos(angle), n = std::sin(angle), there = std::min(1.0, s / 0.4);
    const double from = 16 * mm * c, to = -3 * mm * c;
    const double half_width = (16 - 2 * there - 0.02 * s) * mm;
    const double gap = (n < 0 ? left : right) * 2 * std::abs(n) + 0.2 * mm;
    return {from + s * (to - from), half_width * n, 0.5 * gap * c * there};
  };
  return sheet;
}

Sheet sheet_of(const ClosedShape &closed, size_t around, size_t rings) {
  Sheet sheet;
  sheet.around = around;
  sheet.rings = rings;
  sheet.at = [=](double angle, double s) -> Vec3 {
    const double side = std::clamp(1e3 * std::cos(angle), -1.0, 1.0);
    const double length =
        0.5 * ((1 + side) * closed.anterior_wall + (1 - side) * closed.posterior_wall);
    const double down = std::max(0.0, 2 * s - 1) * length;
    const Vec3 wall =
        closed.wall(closed.half_width * std::sin(angle), down, side) - Vec3(0, 0, closed.depth);
    const double belly = std::min(1.0, 2 * s);
    return (1 - belly) * closed.rim(angle, side) + belly * wall;
  };
  return sheet;
}

RigidMotion some_rigid_motion() {
  const Eigen::AngleAxisd turn(1.1, Vec3(0.3, -0.7, 0.5).normalized());
  return {turn.toRotationMatrix(), {0.12, -0.05, 0.31}};
}

std::vector<Vec3> moved(const std::vector<Vec3> &x, const std::function<Vec3(const Vec3 &)> &by) {
  std::vector<Vec3> result;
  result.reserve(x.size());
  for (const Vec3 &p : x) result.push_back(by(p));
  return result;
}

std::vector<Vec3> Renumbered::operator()(const std::vector<Vec3> &x) const {
  std::vector<Vec3> result(x.size());
  for (size_t n = 0; n < x.size(); ++n) result[place[n]] = x[n];
  return result;
}

Renumbered renumbered(const Valve &valve) {
  Renumbered other;
  const size_t n = valve.rest.size();
  size_t step = n / 3;
  while (n % step == 0 || std::gcd(step, n) != 1) ++step;
  for (size_t k = 0; k < n; ++k) other.place.push_back(static_cast<uint32_t>(k * step % n));
  Valve copy = valve;
  copy.rest = other(valve.rest);
  copy.loaded = other(valve.loaded);
  for (Tri &triangle : copy.triangles) {
    for (uint32_t &node : triangle) node = other.place[node];
  }
  for (uint32_t &node : copy.annulus) node = other.place[node];
  for (Head &head : copy.heads) head.node = other.place[head.node];
  for (Chord &chord : copy.chords) {
    chord.a = other.place[chord.a];
    chord.b = other.place[chord.b];
  }
  other.model = make_model(std::move(copy));
  return other;
}

}  // namespace mvs::core::test
