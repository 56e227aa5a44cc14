// A pyramid of springs with one chord, whose height is known in closed form.
#pragma once

#include <algorithm>
#include <cmath>

#include "sensitivity/sensitivity.h"
#include "tests/solve/bench.h"

namespace mvs::core::test {

// Six triangles around an apex at height z, the rim fixed, under the pressure p; a chord of rest
// length L0 leads from the apex down to a head at height -d. The apex is in equilibrium where
//     6 k (1 - R / L) z + E A ((z + d) / L0 - 1) = p B / 3,   L^2 = r^2 + z^2,
// R the rest length of the springs, k = low t (area of two triangles) / R^2, B the area of the
// base.
struct Pyramid {
  static constexpr double radius = 10e-3, rest_height = 3e-3, depth = 12e-3, height = 5e-3;
  Model model;
  State state;
  double rest_length, k, base;

  explicit Pyramid(double chord_strain = 0.02) {
    Valve valve;
    valve.bending_scale = 0;
    valve.contact_thickness = 1e-4;
    valve.rest.push_back({0, 0, rest_height});
    for (uint32_t i = 0; i < 6; ++i) {
      valve.rest.push_back({radius * std::cos(i * pi / 3), radius * std::sin(i * pi / 3), 0});
      valve.triangles.push_back({0, 1 + i, 1 + (i + 1) % 6});
    }
    valve.rest.push_back({0, 0, -depth});
    valve.heads.push_back({1, "PM1", 7});
    Chord chord;
    chord.a = 7;
    chord.b = 0;
    chord.rest_length = (height + depth) / (1 + chord_strain);
    chord.young = 1e6;
    valve.chords.push_back(chord);
    valve.leaflets.resize(1);
    valve.leaflets[0].name = "A";
    model = model_of_sheet(valve, {1, 2, 3, 4, 5, 6, 7});
    rest_length = std::hypot(radius, rest_height);
    k = 100e3 * 1e-3 * 2 * model.rest_area[0] / (rest_length * rest_length);
    base = 6 * std::sqrt(0.75) / 2 * radius * radius;
    state = initial_state(model);
    state.x.edit()[0].z() = height;
    state.load.pressure = 3 / base * (spring() + tension());
    state.rest_tolerance = 1e-12;
  }
  const Chord &chord() const { return model.valve.chords[0]; }
  double length() const { return std::hypot(radius, height); }
  double spring() const { return 6 * k * (1 - rest_length / length()) * height; }
  double tension() const {
    return std::max(0.0,
                    chord().young * chord().area * ((height + depth) / chord().rest_length - 1));
  }
  double chord_stiffness() const { return chord().young * chord().area / chord().rest_length; }
  double sheet_stiffness() const {
    return 6 * k * (1 - rest_length * radius * radius / std::pow(length(), 3));
  }
};

inline const Quantity apex = {QuantityKind::node_position, 0, 2, nullptr, Vec3::Zero(), {}};
inline const Quantity tension_of_chord = {
    QuantityKind::chord_tension, 0, 0, nullptr, Vec3::Zero(), {}};

}  // namespace mvs::core::test
