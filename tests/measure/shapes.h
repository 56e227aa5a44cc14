// Fixtures: shapes with known measures, sheets between an annulus and a free edge given by a map.
#pragma once

#include <doctest/doctest.h>

#include <functional>
#include <numbers>
#include <vector>

#include "model/model.h"
#include "tests/about.h"

namespace mvs::core::test {

inline constexpr double pi = std::numbers::pi;

inline constexpr double contact_thickness = 0.6e-3;

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
Sheet disc(double radius, double hole, std::function<double(double x, double y)> height);

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
