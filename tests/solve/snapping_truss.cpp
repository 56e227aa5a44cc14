// Stability of a truss that snaps through, against its closed form: margins at any height, the
// critical pressure, a chord to a point without stiffness, and solvers that leave the equilibrium.
#include <cmath>

#include "solve/nodes.h"
#include "solve/stability.h"
#include "tests/solve/bench.h"

namespace mvs::core::test {
namespace {

// Six triangles around an apex, springs without bending, the rim fixed. Under the pressure p the
// apex carries p A / 3, A the area of the base, at any height z. The springs of rest length L0 and
// stiffness k carry 6 k (1 - L0 / L) z, L^2 = r^2 + z^2, k = E t (area of two triangles) / L0^2: a
// von Mises truss, which snaps at L^3 = L0 r^2.
struct Pyramid {
  static constexpr double radius = 10e-3, height = 3e-3, young = 100e3, thickness = 1e-3;
  Model model;
  double rest_length, k, base;

  Pyramid() {
    Valve valve;
    valve.bending_scale = 0;
    valve.contact_thickness = 1e-4;
    valve.rest.push_back({0, 0, height});
    for (uint32_t i = 0; i < 6; ++i) {
      valve.rest.push_back({radius * std::cos(i * pi / 3), radius * std::sin(i * pi / 3), 0});
      valve.triangles.push_back({0, 1 + i, 1 + (i + 1) % 6});
    }
    valve.leaflets.resize(1);
    valve.leaflets[0].thickness = thickness;
    model = model_of_sheet(valve, {1, 2, 3, 4, 5, 6});
    rest_length = std::sqrt(radius * radius + height * height);
    k = young * thickness * 2 * model.rest_area[0] / (rest_length * rest_length);
    base = 6 * std::sqrt(0.75) / 2 * radius * radius;
  }
  double length(double z) const { return std::sqrt(radius * radius + z * z); }
  // The upward force of the springs.
  double force(double z) const { return -6 * k * (1 - rest_length / length(z)) * z; }
  double pressure_at(double z) const { return -3 * force(z) / base; }
  // Vertical and lateral eigenvalue.
  double vertical(double z) const {
    return 6 * k * (1 - rest_length * radius * radius / std::pow(length(z), 3));
  }
  double snap_height() const {
    return std::sqrt(std::pow(rest_length * radius * radius, 2.0 / 3) - radius * radius);
  }
  State at(double z) const {
    State state = initial_state(model);
    state.x.edit()[0].z() = z;
    state.load.pressure = pressure_at(z);
    return state;
  }
};

}  // namespace

// Held where it is, the point would make an anchor of the chord, and the truss stable.
TEST_CASE("a_chord_to_a_point_that_nothing_else_holds_has_no_stiffness") {
  const Pyramid pyramid;
  const double z = 0.8 * pyramid.snap_height(), length = 5e-3;
  Valve valve = pyramid.model.valve;
  const Vec3 apex(0, 0, z), point = apex + (1 + 1e-9) * length * Vec3::UnitZ();
  valve.rest.push_back(point);
  valve.rest.push_back(point + length * Vec3::UnitX());
  Chord chord, trunk;
  chord.id = 1;
  chord.a = 7;
  chord.b = 0;
  chord.rest_length = length;
  trunk.id = 2;
  trunk.a = 8;
  trunk.b = 7;
  trunk.rest_length = 2 * length;  // slack
  valve.chords.push_back(chord);
  valve.chords.push_back(trunk);
  const Model model = model_of_sheet(valve, {1, 2, 3, 4, 5, 6, 8});
  State state = initial_state(model);
  state.x.edit()[0] = apex;
  state.load.pressure = pyramid.pressure_at(z);
  const Stability tight = check_stability(model, state);
  CHECK_FALSE(tight.is_stable);
  CHECK(tight.stiffness == about(pyramid.vertical(z), 0.01));
  // with a trunk that is tight as well it is an anchor
  valve.chords[1].rest_length = (1 - 1e-6) * length;
  valve.rest[8] = point + length * Vec3::UnitZ();
  const Model in_line = model_of_sheet(valve, {1, 2, 3, 4, 5, 6, 8});
  State held = initial_state(in_line);
  held.x.edit()[0] = apex;
  held.load.pressure = pyramid.pressure_at(z);
  CHECK(check_stability(in_line, held).is_stable);
}

TEST_CASE("a_truss_snaps_at_its_critical_pressure") {
  const Pyramid pyramid;
  const double z = pyramid.snap_height();
  for (const double above : {0.9, 0.2, 0.02, 0.001}) {
    const Stability before = check_stability(pyramid.model, pyramid.at(z * (1 + above)));
    CHECK(before.is_stable);
    CHECK(before.stiffness == about(pyramid.vertical(z * (1 + above)), 0.01));
    const Stability after = check_stability(pyramid.model, pyramid.at(z * (1 - above)));
    CHECK_FALSE(after.is_stable);
    CHECK(after.stiffness == about(pyramid.vertical(z * (1 - above)), 0.01));
    CHECK(std::abs(after.mode[0].z()) == about(1, 1e-6));
  }
  // under 0.999 and 1.001 times the critical pressure
  State below = pyramid.at(z), beyond = below;
  below.load.pressure *= 0.999;
  beyond.load.pressure *= 1.001;
  SolveOptions options;
  options.residual = 1e-9;
  const Settled held = settle(pyramid.model, below, options);
  CHECK(held.stats.converged);
  CHECK(held.state.x[0].z() > z);
  const Settled snapped = settle(pyramid.model, beyond, options);
  CHECK(snapped.stats.converged);
  CHECK(snapped.state.x[0].z() < 0);
}

TEST_CASE("every_solver_leaves_an_unstable_equilibrium") {
  const Pyramid pyramid;
  const double z = 0.5 * pyramid.snap_height();
  const State balanced = pyramid.at(z);
  for (const SolverKind solver :
       {SolverKind::newton, SolverKind::implicit_euler, SolverKind::explicit_euler}) {
    SolveOptions options;
    options.solver = solver;
    options.damping = 500;
    options.checks_stability = true;
    const Settled settled = settle(pyramid.model, balanced, options);
    CHECK(settled.stats.converged);
    CHECK(settled.stats.stable);
    CHECK(settled.stats.stiffness_margin > 0);
    CHECK(std::abs(settled.state.x[0].z() - z) > 1e-4);
    options.margins = false;
    const Settled without = settle(pyramid.model, balanced, options);
    CHECK(without.stats.stable);
    CHECK(without.stats.stiffness_margin == 0);
    CHECK(same_bits(without.state.x.get(), settled.state.x.get()));
  }
  SolveOptions options;
  options.max_iterations = 1;
  const Settled stopped = settle(pyramid.model, balanced, options);
  CHECK_FALSE(stopped.stats.converged);
}

}  // namespace mvs::core::test
