// The insertion of a chord as a parameter: against equilibria of a cable whose end lies inside an
// edge, which the test solves itself.
#include <doctest/doctest.h>

#include <Eigen/LU>
#include <array>
#include <cmath>

#include "base/error.h"
#include "tests/sensitivity/pyramid.h"

namespace mvs::core::test {
namespace {

// The pyramid with a second head beside the first, so that the chord is inclined, and the apex in
// equilibrium under the pressure.
struct Inclined {
  Pyramid p;
  Vec3 head = Vec3(4e-3, 1e-3, -Pyramid::depth), apex_now = Vec3(0.3e-3, -0.2e-3, Pyramid::height);
  double rest_edge;  // m, of the edges at the apex
  double load = 0;   // N, upwards at the apex

  Inclined() : p(0.03) {
    Valve valve = p.model.valve;
    valve.rest.edit()[7] = head;
    p.model = model_of_sheet(valve, {1, 2, 3, 4, 5, 6, 7});
    p.state = initial_state(p.model);
    rest_edge = p.rest_length;
    load = force(apex_now, 1, 0).z();
    p.state.load.pressure = 3 * load / p.base;
    p.state.rest_tolerance = 1e-12;
    apex_now = equilibrium(1, 0);
    REQUIRE(tension(apex_now) > 1e-3);
    p.state.x.edit()[0] = apex_now;
  }

  const Chord &chord() const { return p.model.valve.chords[0]; }
  double tension(const Vec3 &y) const {
    const double strain = (y - head).norm() / chord().rest_length - 1;
    return chord().young * chord().area * strain;
  }
  // The end of the chord with its site moved towards rim node j by s.
  Vec3 end(const Vec3 &a, uint32_t j, double s) const {
    return a + s / rest_edge * (p.model.valve.rest[j] - a);
  }
  // Out-of-balance force of the apex: springs, the share of the chord, the load.
  Vec3 force(const Vec3 &a, uint32_t j, double s) const {
    Vec3 f(0, 0, -load);
    for (uint32_t i = 1; i < 7; ++i) {
      const Vec3 d = a - p.model.valve.rest[i];
      f += p.k * (1 - p.rest_length / d.norm()) * d;
    }
    const Vec3 y = end(a, j, s);
    return f + (1 - s / rest_edge) * tension(y) * (y - head).normalized();
  }
  // Newton's method with a difference Jacobian, to rounding.
  Vec3 equilibrium(uint32_t j, double s) const {
    Vec3 a = apex_now;
    for (int round = 0; round < 30; ++round) {
      const double h = 1e-8;
      Mat3 stiffness;
      for (int axis = 0; axis < 3; ++axis) {
        const Vec3 step = h * Vec3::Unit(axis);
        stiffness.col(axis) = (force(a + step, j, s) - force(a - step, j, s)) / (2 * h);
      }
      a -= stiffness.inverse() * force(a, j, s);
    }
    return a;
  }
};

Parameter site_to(uint32_t node) {
  return {ParameterKind::chord_site, 0, node, {}};
}

}  // namespace

TEST_CASE("an_insertion_that_moves_along_an_edge_moves_the_apex_as_its_equilibria_do") {
  const Inclined valve;
  const State &state = valve.p.state;
  const double h = 1e-6;  // m: error 1e-8 of the central difference, beside 1e-9 of rounding
  std::vector<Quantity> of;
  for (uint32_t axis = 0; axis < 3; ++axis) {
    of.push_back({QuantityKind::node_position, 0, axis, nullptr, Vec3::Zero(), {}});
  }
  of.push_back({QuantityKind::chord_length, 0, 0, nullptr, Vec3::Zero(), {}});
  of.push_back({QuantityKind::chord_tension, 0, 0, nullptr, Vec3::Zero(), {}});
  of.push_back({QuantityKind::head_force, 0, 0, nullptr, Vec3::Zero(), {}});
  of.push_back({QuantityKind::head_force, 0, 3, nullptr, Vec3::Zero(), {}});
  for (const uint32_t j : {1u, 3u, 5u}) {
    const auto values = [&](double s) {
      const Vec3 a = valve.equilibrium(j, s), y = valve.end(a, j, s);
      const Vec3 pull = valve.tension(y) * (y - valve.head).normalized();
      return std::array{a.x(),    a.y(),      a.z(), (y - valve.head).norm(), valve.tension(y),
                        pull.x(), pull.norm()};
    };
    const auto above = values(h), below = values(-h);
    for (const bool direct : {false, true}) {
      SensitivityOptions options;
      options.direct = direct;
      const Sensitivity found = differentiate(valve.p.model, state, of, {site_to(j)}, options);
      CHECK(found.parameter_notes[0] == 0);
      for (size_t q = 0; q < of.size(); ++q) {
        CAPTURE(j);
        CAPTURE(q);
        const double wanted = (above[q] - below[q]) / (2 * h);
        CHECK(std::abs(found.derivative[q] - wanted) < 1e-6 * (std::abs(wanted) + 0.01));
      }
    }
  }
}

TEST_CASE("two_sites_of_one_chord_move_its_end_by_their_sum") {
  const Inclined valve;
  std::vector<Vec3> g(valve.p.model.node_count(), Vec3::Zero());
  const Parameter first = site_to(1), second = site_to(3);
  const std::array<ParameterStep, 2> both = {ParameterStep{&first, 1e-4}, {&second, 2e-4}};
  add_change(valve.p.model, both, valve.p.state.x, g);
  // the same end by hand
  const Vec3 a = valve.apex_now;
  const Vec3 y = a + (valve.end(a, 1, 1e-4) - a) + (valve.end(a, 3, 2e-4) - a);
  const Vec3 pull = valve.tension(y) * (y - valve.head).normalized();
  const Vec3 before = valve.tension(a) * (a - valve.head).normalized();
  const Vec3 wanted = (1 - 3e-4 / valve.rest_edge) * pull - before;
  CHECK((g[0] - wanted).norm() < 1e-12 * pull.norm());
  CHECK((g[1] - 1e-4 / valve.rest_edge * pull).norm() < 1e-12 * pull.norm());
  CHECK((g[3] - 2e-4 / valve.rest_edge * pull).norm() < 1e-12 * pull.norm());
}

TEST_CASE("a_chord_that_ends_on_no_leaflet_or_a_node_without_an_edge_has_no_site") {
  const Inclined valve;
  const auto refused = [&](const Parameter &p, const char *part) {
    try {
      differentiate(valve.p.model, valve.p.state, {apex}, {p}, {});
      FAIL("accepted");
    } catch (const Error &error) {
      CHECK(error.code == MVS_E_ARGUMENT);
      CHECK(std::string(error.what()).find(part) != std::string::npos);
    }
  };
  refused(site_to(7), "no edge leads");
  refused(site_to(100), "no edge leads");
  refused(site_to(0), "no edge leads");
  Parameter beyond = site_to(1);
  beyond.index = 1;
  refused(beyond, "chord segments");
}

}  // namespace mvs::core::test
