// Sensitivities of closed valves against central differences of settles, along random parameters
// and along the gradient; slack chordae have the derivative zero. MVS_TEST_LONG: 200 pairs of valve
// and parameter.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "base/error.h"
#include "tests/sensitivity/random_valves.h"
#include "tests/short_run.h"

namespace mvs::core::test {
namespace {

// The tolerance wanted of derivatives; a displacement of 5e-8 m leaves rounding of about 1e-6.
constexpr double most_error = 1e-4;

// Changes the description of the valve itself.
RandomValve changed(const RandomValve &from, const Parameter &p, double by) {
  Valve valve = from.model->valve;
  State state = from.state;
  const auto shift = [&](uint32_t node, const Vec3 &move) {
    for (CowVector<Vec3> *places : {&valve.open, &valve.loaded, &state.x}) {
      places->edit()[node] += move;
    }
  };
  switch (p.kind) {
    case ParameterKind::chord_rest_length:
      valve.chords.edit()[p.index].rest_length += by;
      break;
    case ParameterKind::chord_area:
      valve.chords.edit()[p.index].area += by;
      break;
    case ParameterKind::chord_young:
      valve.chords.edit()[p.index].young += by;
      break;
    case ParameterKind::leaflet_constant:
      valve.leaflets.edit()[p.index].constants[p.component] += by;
      break;
    case ParameterKind::leaflet_thickness:
      for (size_t t = 0; t < valve.triangles.size(); ++t) {
        if (valve.triangle_leaflet[t] == p.index) valve.triangle_thickness.edit()[t] += by;
      }
      break;
    case ParameterKind::scallop_thickness:
      for (size_t t = 0; t < valve.triangles.size(); ++t) {
        if (valve.triangle_scallop[t] == p.index) valve.triangle_thickness.edit()[t] += by;
      }
      break;
    case ParameterKind::pressure:
      state.load.pressure += by;
      break;
    case ParameterKind::head_position:
      shift(valve.heads[p.index].node, by * Vec3::Unit(static_cast<int>(p.component)));
      break;
    case ParameterKind::node_position:
      shift(p.index, by * Vec3::Unit(static_cast<int>(p.component)));
      break;
    case ParameterKind::boundary_mode:
      for (uint32_t i = 0; i < p.mode.size(); ++i) {
        if (!p.mode[i].isZero(0)) shift(i, by * p.mode[i]);
      }
      break;
    default:
      FAIL("not among the parameters of this test");
  }
  return {make_model(valve), state};
}

Parameter random_parameter(const RandomValve &closed, Random &random) {
  const Valve &valve = closed.model->valve;
  const auto any = [&](size_t count) {
    return static_cast<uint32_t>(random(0, static_cast<double>(count)));
  };
  using Kind = ParameterKind;
  const Kind kinds[] = {Kind::chord_rest_length, Kind::chord_area,        Kind::chord_young,
                        Kind::leaflet_constant,  Kind::leaflet_thickness, Kind::scallop_thickness,
                        Kind::pressure,          Kind::head_position,     Kind::node_position,
                        Kind::boundary_mode};
  Parameter p;
  p.kind = kinds[any(10)];
  // half of all, as it matters most
  if (random(0, 1) < 0.4) p.kind = Kind::chord_rest_length;
  if (p.kind <= Kind::chord_area) p.index = any(valve.chords.size());
  if (p.kind == Kind::leaflet_constant) p.index = any(valve.leaflets.size());
  if (p.kind == Kind::leaflet_thickness) p.index = any(valve.leaflets.size());
  if (p.kind == Kind::scallop_thickness) p.index = any(valve.scallops.size());
  if (p.kind == Kind::head_position) {
    p.index = any(valve.heads.size());
    p.component = any(3);
  }
  if (p.kind == Kind::node_position) {
    p.index = valve.annulus[any(valve.annulus.size())];
    p.component = any(3);
  }
  if (p.kind == Kind::boundary_mode) {
    p.mode.assign(closed.model->node_count(), Vec3::Zero());
    for (const uint32_t node : valve.annulus) p.mode[node] = random.vector(1);
  }
  return p;
}

double fastest_of(const NodeField &field) {
  double most = 0;
  for (const Vec3 &v : field) most = std::max(most, v.norm());
  return most;
}

double value_of(const RandomValve &closed, const Quantity &q) {
  return quantity_gradient(*closed.model, closed.state, q).value;
}

// One pair of a valve and a parameter, or of a valve and the gradient of a functional over all rest
// lengths: what the derivative says, and a central difference of two settles.
struct Compared {
  bool smooth;
  double motion_error, functional_error;  // relative
  mvs_sensitivity_notes notes = 0;        // of the parameter
};

// The fastest node moves by `distance`.
Compared compared_at(const RandomValve &closed, const Quantity &q,
                     const std::vector<Parameter> &parameters, const std::vector<double> &direction,
                     const NodeField &motion, bool smooth, double distance) {
  const double h = distance / fastest_of(motion);
  RandomValve above = closed, below = closed;
  double slope = 0;
  for (size_t p = 0; p < parameters.size(); ++p) {
    above = changed(above, parameters[p], h * direction[p]);
    below = changed(below, parameters[p], -h * direction[p]);
  }
  above = settled(above);
  below = settled(below);
  NodeField error(motion.size(), Vec3::Zero());
  for (uint32_t i = 0; i < error.size(); ++i) {
    slope += q.weights[i].dot(motion[i]);
    if (is_idle(closed, i)) continue;
    error[i] = (above.state.x[i] - below.state.x[i]) / (2 * h) - motion[i];
  }
  const double difference = (value_of(above, q) - value_of(below, q)) / (2 * h);
  return {smooth, fastest_of(error) / fastest_of(motion), std::abs(difference / slope - 1)};
}

Compared compare(const RandomValve &closed, const Quantity &q,
                 const std::vector<Parameter> &parameters, const std::vector<double> &direction,
                 const NodeField &motion, bool smooth, double slack) {
  if (fastest_of(motion) == 0) return {smooth, 0, 0};  // all chordae are slack: nothing to compare
  const auto at = [&](double distance) {
    return compared_at(closed, q, parameters, direction, motion, smooth, distance);
  };
  const Compared found = at(0.5 * slack);
  // a derivative that changes by 2 % within the slack differs by 1e-4 from a central difference
  // over half of it, and by 4e-6 over a tenth
  return smooth && found.motion_error > most_error ? at(0.1 * slack) : found;
}

Compared along_a_parameter(const RandomValve &closed, const Quantity &q, const Parameter &p) {
  SensitivityOptions options;
  options.with_motion = true;
  const Sensitivity found = differentiate(*closed.model, closed.state, {q}, {p}, options);
  Compared compared =
      compare(closed, q, {p}, {1}, found.motion, found.parameter_notes[0] == 0, options.slack);
  compared.notes = found.parameter_notes[0];
  return compared;
}

// Adjoint and direct derivatives agree, and both with the difference.
Compared along_the_gradient(const RandomValve &closed, const Quantity &q) {
  std::vector<Parameter> lengths;
  for (uint32_t c = 0; c < closed.model->valve.chords.size(); ++c) {
    lengths.push_back({ParameterKind::chord_rest_length, c, 0, {}});
  }
  const Sensitivity adjoint = differentiate(*closed.model, closed.state, {q}, lengths, {});
  CHECK(adjoint.adjoint_solves >= 1);
  SensitivityOptions options;
  options.with_motion = true;
  options.tests = false;
  const Sensitivity direct = differentiate(*closed.model, closed.state, {q}, lengths, options);
  std::vector<double> direction;
  NodeField motion(closed.model->node_count(), Vec3::Zero());
  double largest = 0;
  for (const double d : adjoint.derivative) largest = std::max(largest, std::abs(d));
  for (size_t p = 0; p < lengths.size(); ++p) {
    // both have a relative error of the linear solutions, below 1e-11
    CHECK(std::abs(adjoint.derivative[p] - direct.derivative[p]) < 1e-9 * largest);
    const double rest = closed.model->valve.chords[p].rest_length;
    direction.push_back(rest * rest * adjoint.derivative[p]);
    for (size_t i = 0; i < motion.size(); ++i) {
      motion[i] += direction[p] * direct.motion[p * motion.size() + i];
    }
  }
  return compare(closed, q, lengths, direction, motion, adjoint.quantity_notes[0] == 0,
                 options.slack);
}

}  // namespace

TEST_CASE("slack_chordae_change_nothing_and_are_declared_smooth") {
  const double away = 2e-7;  // m, twice the slack of the side test
  uint64_t seed = 100;
  Random random(seed);
  for (int valve = 0; valve < 3; ++valve) {
    const RandomValve closed = some_valve(random, seed);
    std::vector<Parameter> lengths;
    for (uint32_t c = 0; c < closed.model->valve.chords.size(); ++c) {
      const Chord &chord = closed.model->valve.chords[c];
      const double length = (closed.state.x[chord.a] - closed.state.x[chord.b]).norm();
      if (length > chord.rest_length - away || is_idle(closed, chord.a) || is_idle(closed, chord.b))
        continue;
      lengths.push_back({ParameterKind::chord_rest_length, c, 0, {}});
    }
    SensitivityOptions options;
    options.with_motion = true;
    const Sensitivity found = differentiate(*closed.model, closed.state,
                                            {random_functional(closed, random)}, lengths, options);
    for (size_t p = 0; p < lengths.size(); ++p) {
      CAPTURE(lengths[p].index);
      CHECK(found.derivative[p] == 0);
      CHECK(found.parameter_notes[p] == 0);
    }
    MESSAGE(lengths.size() << " slack chordae");
  }
}

TEST_CASE("derivatives_that_are_declared_smooth_match_central_differences") {
  const bool is_long = long_run();
  const int pairs = is_long ? 200 : 8;
  int smooth = 0, wrong = 0, cases = 0, switching = 0, on_sides = 0, unexplained = 0;
  double worst = 0, worst_functional = 0;
  uint64_t seed = 100;
  for (int pair = 0; pair < pairs; ++pair) {
    Random random(seed);
    const RandomValve closed = some_valve(random, seed);
    const Parameter p = random_parameter(closed, random);
    const Quantity q = random_functional(closed, random);
    for (const bool gradient : {false, true}) {
      Compared found = {false, 0, 0};
      try {
        found = gradient ? along_the_gradient(closed, q) : along_a_parameter(closed, q, p);
      } catch (const NotAtRest &) {
        MESSAGE("pair " << pair << ": a moved valve does not come to rest at 1e-10 N");
      } catch (const Error &error) {
        // refused, with its reason: not declared smooth
        CHECK(error.code == MVS_E_DIVERGED);
        MESSAGE("pair " << pair << ": " << std::string(error.what()));
      }
      CAPTURE(pair);
      CAPTURE(gradient);
      ++cases;
      switching += found.notes != 0;
      unexplained += found.notes == MVS_SENSITIVITY_NOTE_SWITCH;
      on_sides += (found.notes & MVS_SENSITIVITY_NOTE_SIDES) != 0;
      if (!found.smooth) continue;
      ++smooth;
      CHECK(found.motion_error < most_error);
      wrong += found.motion_error >= most_error;
      worst = std::max(worst, found.motion_error);
      worst_functional = std::max(worst_functional, found.functional_error);
    }
  }
  MESSAGE(smooth << " of " << cases << " declared smooth, " << wrong
                 << " of them wrong; largest error " << worst << " of positions, "
                 << worst_functional << " of functionals; of " << switching
                 << " parameters with notes " << on_sides
                 << " have confirmed values on both sides, " << unexplained
                 << " no switch that is listed");
  CHECK(smooth >= 0.8 * cases);
  CHECK(unexplained <= 0.01 * cases);  // a curvature of 3 % within the slack
}

}  // namespace mvs::core::test
