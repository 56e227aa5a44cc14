// One-sided derivatives: a pyramid of springs whose apex touches a wall, leaves its edge, or
// stretches springs to the kink of their law, in closed form; the small problem by enumeration; and
// a closed valve with a chord that has just become taut, against one-sided differences of settles.
#include <doctest/doctest.h>

#include <cmath>

#include "anatomy/parametric.h"
#include "energy/barrier.h"
#include "sensitivity/switch_problem.h"
#include "tests/sensitivity/pyramid.h"

namespace mvs::core::test {
namespace {

using Kind = ParameterKind;

// The pyramid without its chord under a fixed triangle, whose plane is `gap` above the apex.
struct Wall {
  static constexpr double slack = 1e-6;  // m
  Pyramid p;
  double gap, strength;

  explicit Wall(double stiffness, double gap_, double edge_at = -20e-3) : p(-0.5), gap(gap_) {
    Valve valve = p.model.valve;
    const double z = Pyramid::height + gap;
    valve.contact_stiffness = stiffness;
    // the apex is closest to the inside if edge_at < 0, to the edge x = edge_at otherwise
    valve.rest.push_back({edge_at, -50e-3, z});
    valve.rest.push_back({edge_at + 90e-3, 0, z});
    valve.rest.push_back({edge_at, 50e-3, z});
    valve.triangles.push_back({8, 9, 10});
    p.model = model_of_sheet(valve, {1, 2, 3, 4, 5, 6, 7, 8, 9, 10});
    p.state = initial_state(p.model);
    p.state.x.edit()[0].z() = Pyramid::height;
    strength = 0.5 * stiffness * p.model.vertex_area[0];
    p.state.load.pressure = 3 / p.base * (p.spring() + push(0));
    p.state.rest_tolerance = 1e-12;
  }
  double range() const { return p.model.valve.contact_thickness; }
  double push(double up) const { return -strength * barrier((gap - up) / range()).first; }
  double push_slope(double up) const {
    return strength / range() * barrier((gap - up) / range()).second;
  }
  // The displacement of the apex for a vertical force, N, with a linear sheet, by bisection.
  double moved_by(double force) const {
    double low = -1e-4, high = 0.9 * gap;
    for (int k = 0; k < 200; ++k) {
      const double u = 0.5 * (low + high);
      (p.sheet_stiffness() * u + push(u) - push(0) < force ? low : high) = u;
    }
    return low;
  }
};

}  // namespace

TEST_CASE("an_apex_that_touches_a_wall_has_a_derivative_on_each_side") {
  // just outside of the range of contact, just inside, and pressed against a stiff wall
  for (const double depth : {-1e-10, 1e-10, 0.3 * Wall::slack}) {
    const Wall wall(20e6, 1e-4 - depth);
    SensitivityOptions options;
    options.slack = Wall::slack;
    const Sensitivity found =
        differentiate(wall.p.model, wall.p.state, {apex}, {{Kind::pressure, 0, 0, {}}}, options);
    REQUIRE(found.weak_contacts.size() == 1);
    CHECK(found.weak_contacts[0] == 0);
    const double push = wall.p.base / 3, now = wall.p.sheet_stiffness() + wall.push_slope(0);
    // the depth of 1e-10 m has a rounding of 1e-18 m, and the contact the stiffness of the sheet
    CHECK(found.derivative[0] == about(push / now, 1e-7));
    // the step along which the apex would move by `slack` alone
    const double force = wall.p.sheet_stiffness() * Wall::slack;
    // rounding of the gap, 1e-16 m of a displacement of 1e-8 m
    CHECK(found.above[0] == about(wall.moved_by(force) / force * push, 1e-8));
    CHECK(found.below[0] == about(-wall.moved_by(-force) / force * push, 1e-8));
    if (depth > 1e-9) continue;
    // the apex hardly moves on, and moves back freely
    CHECK(found.above[0] < 0.03 * found.below[0]);
    CHECK(found.below[0] == about(push / wall.p.sheet_stiffness(), 1e-3));
    CHECK((found.parameter_notes[0] & MVS_SENSITIVITY_NOTE_CONTACT) != 0);
    CHECK((found.parameter_notes[0] & MVS_SENSITIVITY_NOTE_SWITCH) != 0);
    CHECK((found.parameter_notes[0] & MVS_SENSITIVITY_NOTE_SIDES) != 0);
  }
}

TEST_CASE("an_apex_that_leaves_the_edge_of_a_wall_has_a_derivative_on_each_side") {
  for (const double edge : {-1e-12, 1e-12}) {
    Wall wall(80, 0.5e-4, edge);
    wall.p.state.rest_tolerance = 1e-9;  // beyond the edge the force is not quite vertical
    Parameter shift = {Kind::boundary_mode, 0, 0, {}};
    shift.mode.assign(wall.p.model.node_count(), Vec3::Zero());
    for (const size_t i : {8, 9, 10}) shift.mode[i] = Vec3(1, 0, 0);
    const Quantity side = {QuantityKind::node_position, 0, 0, nullptr, Vec3::Zero(), {}};
    const Sensitivity found = differentiate(wall.p.model, wall.p.state, {side}, {shift}, {});
    // springs from the apex: sum of k n n^T + T / L (1 - n n^T) along x
    const double length = wall.p.length(), along = 0.5 * Pyramid::radius * Pyramid::radius;
    const double sheet =
        6 * wall.p.k *
        (1 - wall.p.rest_length / length + wall.p.rest_length / std::pow(length, 3) * along);
    // beyond the edge the force turns towards it; inside nothing holds the apex beside
    const double turn = -wall.push(0) / wall.gap;
    // a wall that moves along x leaves the apex beyond its edge
    CHECK(found.above[0] == about(turn / (sheet + turn), 1e-6));
    CHECK(std::abs(found.below[0]) < 1e-9);
    CHECK(found.derivative[0] == (edge > 0 ? found.above[0] : found.below[0]));
    CHECK((found.parameter_notes[0] & MVS_SENSITIVITY_NOTE_CONTACT) != 0);
    CHECK((found.parameter_notes[0] & MVS_SENSITIVITY_NOTE_SIDES) != 0);
  }
}

TEST_CASE("springs_at_the_kink_of_their_law_have_a_derivative_on_each_side") {
  Pyramid p(-0.5);
  const double strain = p.length() / p.rest_length - 1, high = 6e6;
  // 1e-10: below the kink by rounding
  p.model.valve.leaflets.edit()[0].constants = {100e3, high, strain + 1e-10};
  const Sensitivity found =
      differentiate(p.model, p.state, {apex}, {{Kind::pressure, 0, 0, {}}}, {});
  const double stiff = high / 100e3, sine = p.height / p.length();
  const double tension = p.spring() / sine;
  const double beyond = 6 * p.k * stiff * sine * sine + tension / p.length() * (1 - sine * sine);
  CHECK(found.above[0] == about(p.base / 3 / beyond, 1e-6));
  CHECK(found.below[0] == about(p.base / 3 / p.sheet_stiffness(), 1e-6));
  CHECK((found.parameter_notes[0] & MVS_SENSITIVITY_NOTE_KINK) != 0);
  CHECK((found.parameter_notes[0] & MVS_SENSITIVITY_NOTE_SIDES) != 0);
  CHECK(found.weak_contacts.empty());
}

// Stable switches of random stiffness: I + S K has positive principal minors, and one state fits.
TEST_CASE("the_active_set_finds_what_enumeration_finds") {
  Random random(5);
  for (int trial = 0; trial < 50; ++trial) {
    constexpr size_t m = 6;
    std::vector<Switch> switches(m);
    std::vector<double> flexibility(m * m, 0), rates;
    Eigen::MatrixXd half(m, m), s(m, m);
    for (int i = 0; i < half.size(); ++i) half.data()[i] = random(-1, 1);
    s = half * half.transpose();
    for (size_t i = 0; i < m; ++i) {
      (random(0, 1) < 0.5 ? switches[i].up : switches[i].down) = random(0, 30);
      rates.push_back(random(-1, 1));
      for (size_t j = 0; j < m; ++j) {
        flexibility[i * m + j] = s(static_cast<int>(i), static_cast<int>(j));
      }
    }
    const std::vector<double> t = extra_forces(switches, flexibility, rates, 1e-7);
    REQUIRE(t.size() == m);
    int consistent = 0;
    double nearest = 1;
    for (uint32_t state = 0; state < 1u << m; ++state) {
      const auto slope = [&](size_t i) {
        return (state >> i & 1) != 0 ? switches[i].up : switches[i].down;
      };
      Eigen::MatrixXd a = Eigen::MatrixXd::Identity(m, m);
      for (size_t j = 0; j < m; ++j)
        a.col(static_cast<int>(j)) += slope(j) * s.col(static_cast<int>(j));
      const Eigen::VectorXd u =
          a.partialPivLu().solve(Eigen::Map<Eigen::VectorXd>(rates.data(), m));
      bool fits = true;
      double error = 0;
      for (size_t i = 0; i < m; ++i) {
        fits = fits && (u[static_cast<int>(i)] > 0) == ((state >> i & 1) != 0);
        error = std::max(error, std::abs(slope(i) * u[static_cast<int>(i)] - t[i]));
      }
      if (!fits) continue;
      ++consistent;
      nearest = std::min(nearest, error);
    }
    CHECK(consistent == 1);
    CHECK(nearest < 1e-9);  // rounding of systems of condition up to 1e4
  }
}

// An additional chord gets the length that its ends are apart: it bears nothing yet.
TEST_CASE("a_chord_of_a_closed_valve_that_is_just_taut_matches_one_sided_differences") {
  mvs_parametric_desc desc = {};
  desc.struct_size = sizeof desc;
  desc.vertices = 250;
  Valve valve = make_parametric_valve(desc);
  SolveOptions exact;
  exact.residual = 1e-10;
  const auto settled = [&](const ModelPtr &model, State state) {
    state.rest_tolerance = 0;
    REQUIRE(Solver(Backend::fastest).settle(*model, state, exact, nullptr).converged);
    return state;
  };
  ModelPtr model = make_model(valve);
  State state = initial_state(*model);
  state.load = {16e3, 1};
  state = settled(model, state);
  // an additional chord, to a leaflet vertex in the middle of the triangles
  size_t t = valve.triangles.size() / 2;
  while (model->topology.fixed[valve.triangles[t][0]]) ++t;
  valve.chords.push_back(valve.chords[0]);
  Chord &chord = valve.chords.edit().back();
  const auto added = static_cast<uint32_t>(valve.chords.size() - 1);
  chord.name = "just taut";
  chord.id = valve.next_id++;
  chord.a = valve.heads[0].node;
  chord.b = valve.triangles[t][0];
  chord.rest_length = (state.x[chord.b] - state.x[chord.a]).norm();
  model = make_model(valve);
  const Quantity length = {QuantityKind::chord_length, added, 0, nullptr, Vec3::Zero(), {}};
  const Parameter pressure = {Kind::pressure, 0, 0, {}};
  const Sensitivity found = differentiate(*model, state, {length}, {pressure}, {});
  CHECK((found.parameter_notes[0] & MVS_SENSITIVITY_NOTE_CHORD) != 0);
  const double h = 1;  // Pa: moves nodes by about 1e-7 m
  for (const double side : {1.0, -1.0}) {
    State moved = state;
    moved.load.pressure += side * h;
    moved = settled(model, moved);
    const double now = (moved.x[chord.b] - moved.x[chord.a]).norm();
    const double slope = (now - chord.rest_length) / (side * h);
    CAPTURE(side);
    // the curvature along 1 Pa of 16 kPa
    CHECK(slope == about(side > 0 ? found.above[0] : found.below[0], 1e-3));
  }
  const double ratio = found.above[0] / found.below[0];
  CHECK(std::abs(ratio - 1) > 0.1);
}

}  // namespace mvs::core::test
