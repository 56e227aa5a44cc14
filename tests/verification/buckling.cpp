// The length at which a pressurised tube between fixed ends becomes unstable.
//
// Rings of stiff fibres stay circles: each shifts by d(z) and tilts by a(z). With N the axial force
// of the wall, Q = p pi r^2, B the bending stiffness and S the stiffness against shifts without
// tilt, the energy of a small bend is the integral of
//   N d'^2 / 2 - Q (d' a - a^2 / 2) + B a'^2 / 2 + (S - N) (d' - a)^2 / 2.
// Between clamped ends the first mode is a = sin kz with k = 2 pi / L; the least energy over d is
// zero where B k^2 = P (1 + P / S), P = Q - N: the column of Haringx (Philips Research Reports 3,
// 1948). The ends close the tube, so that Q compresses it and only N resists.
#include <cmath>

#include "solve/stability.h"
#include "tests/verification/study.h"
#include "tests/verification/tube.h"

namespace mvs::core::verification {
namespace {

constexpr double radius = 20e-3;     // m, at rest
constexpr double thickness = 1e-3;   // m, the default of a leaflet
constexpr double difference = 1e-4;  // of a strain, for slopes of the stress

struct Loaded {
  Published law;
  double stretch;
  double r() const { return stretch * radius; }
};

// Axes: 0 around, along the fibres; 1 along the tube.
Map2 nominal(const Loaded &tube, double along, double shear) {
  Map2 f = Map2::Zero();
  f(0, 0) = tube.stretch;
  f(1, 1) = along;
  f(0, 1) = shear;
  return nominal_stress(tube.law, f);
}

// Laplace's law: p = T / r.
double pressure(const Loaded &tube) {
  return static_cast<double>(nominal(tube, 1, 0)(0, 0)) * thickness / tube.r();
}

double haringx_length(const Loaded &tube) {
  const double section = test::pi * radius * thickness;  // m2, half of the wall's
  const auto slope = [&](int row, double along, double shear) {
    const Map2 change = nominal(tube, 1 + along, shear) - nominal(tube, 1 - along, -shear);
    return static_cast<double>(change(row, 1)) / (2 * difference);
  };
  const double n = 2 * section * static_cast<double>(nominal(tube, 1, 0)(1, 1));
  const double b = section * tube.r() * tube.r() * slope(1, difference, 0);
  const double s = section * slope(0, 0, difference) + n / 2;
  const double p = pressure(tube) * test::pi * tube.r() * tube.r() - n;
  return 2 * test::pi / std::sqrt(p * (1 + p / s) / b);
}

// N/m, the smallest eigenvalue of the straight tube.
double stiffness(const Loaded &loaded, uint32_t around, double length) {
  const Tube tube =
      tube_drawn_out(loaded.law, radius, {around, around / 4, length}, loaded.stretch);
  State state = initial_state(tube.model);
  state.load = {pressure(loaded), 1};
  state.x = tube.straight;
  return check_stability(tube.model, state).stiffness;
}

// Zero of the stiffness by the secant method, from 5 % to either side of the expected length.
double critical_length(const Loaded &loaded, uint32_t around, double expected) {
  double before = 0.95 * expected, length = 1.05 * expected;
  double stiffness_before = stiffness(loaded, around, before);
  for (int k = 0; k < 4; ++k) {
    const double now = stiffness(loaded, around, length);
    const double next = length - now * (length - before) / (now - stiffness_before);
    before = length;
    stiffness_before = now;
    length = next;
  }
  return length;
}

}  // namespace

std::vector<Study> buckling_studies() {
  Study s;
  s.name = "tube_buckling";
  s.title = "A pressurised tube becomes unstable and bends";
  s.quantity = "critical length over radius";
  s.x = "stretch around";
  s.level = "edge, m";
  s.source = "Haringx (1948): a column with the tube's tangent stiffness in bending and shear";
  s.expects = "2: linear triangles";
  // rings are taken as rigid: they are a hundred times as stiff around as along
  s.tolerance = 0.01;
  s.order_low = 1.7;
  s.order_high = 2.3;
  const Loaded loaded{published("May-Newman and Yin, anterior"), 1.15};
  const double expected = haringx_length(loaded);
  for (uint32_t around = 24; around <= 96; around *= 2) {
    s.rows.push_back({loaded.law.name, loaded.stretch, 2 * test::pi * radius / around,
                      critical_length(loaded, around, expected) / loaded.r(),
                      expected / loaded.r()});
  }
  return {s};
}

}  // namespace mvs::core::verification
