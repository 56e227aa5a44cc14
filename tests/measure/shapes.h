// Fixtures: shapes with known measures, sheets between an annulus and a free edge given by a map.
#pragma once

#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "model/model.h"
#include "tests/about.h"

namespace mvs::core::test {

inline constexpr double pi = std::numbers::pi;

inline constexpr double contact_thickness = 0.6e-3;
inline constexpr double walls_gap = 0.5e-3;  // below the contact thickness

// Nodes at angles 2 pi k / around, from the annulus (s = 0) to the free edge (s = 1). The anterior
// leaflet A lies within +-anterior of angle 0, P is the rest; angle 0 is +x, the atrium is +z.
struct Sheet {
  size_t around = 48, rings = 12;
  double anterior = pi / 2;
  std::function<Vec3(double angle, double s)> at;
};

Valve valve_of(const Sheet &sheet);
ModelPtr model_of(const Sheet &sheet);

// A flat ring of the radius in m with a hole of the second radius, at a height over it.
Sheet disc(double radius, double hole, const std::function<double(double x, double y)> &height);

// Leaflets that overlap, with a gap of two lenses side by side; closed in the middle.
Sheet two_gaps(double left, double right);

// An elliptic annulus whose leaflets slope down to a line of coaptation and there turn into two
// walls. The line runs across, from -half_width to half_width; `wall` gives the wall's point at a
// position along the line, a depth and a side (+1 anterior, -1 posterior).
struct ClosedShape {
  double half_width = 14e-3, depth = 4e-3;
  double anterior_wall = 6e-3, posterior_wall = 6e-3;  // depth of the walls
  std::function<Vec3(double along, double down, double side)> wall = [](double along, double down,
                                                                        double side) -> Vec3 {
    return {0.5 * walls_gap * side, along, -down};
  };
  // the annulus at an angle; seen from above, bellies must not overlap
  std::function<Vec3(double angle, double side)> rim = [](double angle, double) -> Vec3 {
    return {14e-3 * std::cos(angle), 18e-3 * std::sin(angle), 0};
  };
};
Sheet sheet_of(const ClosedShape &closed, size_t around = 96, size_t rings = 24);

struct RigidMotion {
  Mat3 turn;
  Vec3 shift;
  Vec3 operator()(const Vec3 &p) const { return turn * p + shift; }
};
RigidMotion some_rigid_motion();
std::vector<Vec3> moved(const std::vector<Vec3> &x, const std::function<Vec3(const Vec3 &)> &by);

// The same valve with its nodes in another order; `place` returns the new number of each node.
struct Renumbered {
  ModelPtr model;
  std::vector<uint32_t> place;
  std::vector<Vec3> operator()(const std::vector<Vec3> &x) const;
};
Renumbered renumbered(const Valve &valve);

}  // namespace mvs::core::test
