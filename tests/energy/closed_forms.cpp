// Equilibria of springs and chordae against closed forms. tests/verification has more of them, and
// those of the membrane.
#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "model/law.h"
#include "tests/solve/bench.h"

using namespace mvs::core;
using namespace mvs::core::test;

namespace {

Chord chord_between(uint32_t a, uint32_t b) {
  Chord chord;
  chord.a = a;
  chord.b = b;
  return chord;
}

// The centre deflection of a clamped membrane of linear tissue under pressure.
double deflection(const Model &model, double pressure) {
  SolveOptions options;
  options.residual = 1e-9;
  const Settled settled = settle(model, pressure, 0, options);
  REQUIRE(settled.stats.converged);
  return settled.state.x[0].z();
}

void make_linear_membrane(Valve &valve) {
  valve.leaflets.resize(1);
  valve.leaflets[0].constants = {100e3, 100e3, 10};
  valve.bending_scale = 0;
}

}  // namespace

TEST_CASE("the_bilinear_law_is_the_published_curve") {
  for (const Cells &row : reference_table("a_bilinear.csv")) {
    const double strain = std::stod(row[0]), kpa = std::stod(row[1]);
    CAPTURE(strain);
    // the table has ten digits
    CHECK(std::abs(Bilinear(Leaflet().constants).stress(strain) * 1e-3 - kpa) < 1e-9 * (1 + kpa));
  }
}

TEST_CASE("a_branching_chord_balances_three_tensions") {
  // a Y of chordae between three fixed points; by symmetry its node is on the axis, where
  // E A (L1 - l1) / l1 = 2 E A (L2 - l2) / l2 cos(angle): solved by bisection here
  Valve valve;
  valve.rest = {Vec3(0, 0, -20e-3), Vec3(-6e-3, 0, 0), Vec3(6e-3, 0, 0), Vec3(1e-3, 2e-3, -9e-3)};
  valve.chords = {chord_between(0, 3), chord_between(3, 1), chord_between(3, 2)};
  valve.chords[0].rest_length = 10e-3;
  valve.chords[1].rest_length = valve.chords[2].rest_length = 9e-3;
  const Model model = model_of_sheet(valve, {0, 1, 2});
  SolveOptions options;
  options.residual = 1e-10;
  const Settled settled = settle(model, 0, 0, options);
  REQUIRE(settled.stats.converged);
  double low = -20e-3, high = 0;
  for (int k = 0; k < 60; ++k) {
    const double z = 0.5 * (low + high), side = std::hypot(6e-3, z);
    const double down = std::max((z + 20e-3) / 10e-3 - 1, 0.0);
    const double up = 2 * std::max(side / 9e-3 - 1, 0.0) * -z / side;
    (down > up ? high : low) = z;
  }
  // 1e-10 N over a stiffness of 31 N / 20 mm and, across, tension / length of 0.3 N / 0.01 m
  CHECK((settled.state.x[3] - Vec3(0, 0, low)).norm() < 1e-10);
}

TEST_CASE("a_clamped_membrane_converges_with_its_mesh") {
  std::array<double, 3> height;
  for (uint32_t k = 0; k < 3; ++k) {
    height[k] = deflection(clamped_hexagon(4u << k, 10e-3, make_linear_membrane), 50);
  }
  const double order = std::log2(std::abs(height[0] - height[1]) / std::abs(height[1] - height[2]));
  CAPTURE(height[0]);
  CAPTURE(height[1]);
  CAPTURE(height[2]);
  // springs are linear elements: second order, but for the corners of the hexagon
  CHECK(order > 1.5);
  CHECK(order < 2.5);
}

TEST_CASE("a_clamped_disc_deflects_as_in_hencky_1915") {
  // Hencky (1915) for nu = 1/3, that of an equilateral lattice: w0 = 0.6448 a (p a / E t)^(1/3)
  const double pressure = 50,
               height = deflection(clamped_disc(16, 10e-3, make_linear_membrane), 50);
  const double hencky = 0.64478 * 10e-3 * std::cbrt(pressure * 10e-3 / (100e3 * 1e-3));
  // rings of triangles are no equilateral lattice: their nu differs a little from 1/3
  CHECK(height == about(hencky, 0.02));
}

TEST_CASE("the_deflection_of_a_membrane_grows_with_the_cube_root_of_pressure") {
  // Hencky's law while strains are small: 8 times the pressure, twice the deflection
  const Model model = clamped_hexagon(8, 10e-3, make_linear_membrane);
  // strains of 1 %: they enter Hencky's equations as 1 + e
  CHECK(deflection(model, 16) / deflection(model, 2) == about(2, 0.01));
}
