// Fixture: a small valid valve made by hand, to start from or to spoil.
#pragma once

#include <cmath>

#include "model/valve.h"

namespace mvs::core {

inline constexpr uint32_t small_segments = 16, small_rows = 4;

// A funnel that hangs from a round annulus of 30 mm in the plane z = 0 down to z = -18 mm, with the
// atrium above: one half is leaflet A, the other P; two heads at z = -25 mm. A chord leads from a
// head to every second node of the free edge, and one chord per head branches.
inline Valve small_valve() {
  Valve valve;
  valve.name = "small";
  const double pi = std::acos(-1.0);
  for (uint32_t row = 0; row < small_rows; ++row) {
    const double radius = 15e-3 - 2e-3 * row, depth = -6e-3 * row;
    for (uint32_t s = 0; s < small_segments; ++s) {
      const double angle = 2 * pi * s / small_segments;
      valve.rest.push_back({radius * std::cos(angle), radius * std::sin(angle), depth});
    }
  }
  for (uint32_t row = 0; row + 1 < small_rows; ++row) {
    for (uint32_t s = 0; s < small_segments; ++s) {
      const uint32_t next = (s + 1) % small_segments;
      const uint32_t a = row * small_segments + s, b = row * small_segments + next;
      const uint32_t c = a + small_segments, d = b + small_segments;
      valve.triangles.push_back({a, b, c});
      valve.triangles.push_back({b, d, c});
      for (int k = 0; k < 2; ++k) valve.triangle_leaflet.push_back(s < small_segments / 2 ? 0 : 1);
    }
  }
  for (uint32_t s = 0; s < small_segments; ++s) valve.annulus.push_back(s);
  valve.leaflets.resize(2);
  valve.leaflets[0].name = "A";
  valve.leaflets[1].name = "P";
  const uint32_t edge = (small_rows - 1) * small_segments;
  for (uint32_t h = 0; h < 2; ++h) {
    const uint32_t head = static_cast<uint32_t>(valve.rest.size());
    const double x = h == 0 ? 8e-3 : -8e-3;
    valve.rest.push_back({x, 0, -25e-3});
    valve.rest.push_back({x, 0, -22e-3});
    valve.heads.push_back({0, "", head});
    const auto chord = [&](uint32_t a, uint32_t b, ChordKind kind) {
      Chord made;
      made.a = a;
      made.b = b;
      made.kind = kind;
      valve.chords.push_back(made);
    };
    chord(head, head + 1, ChordKind::trunk);
    const uint32_t s = h == 0 ? 0 : small_segments / 2;
    chord(head + 1, edge + s, ChordKind::marginal);
    chord(head + 1, edge - small_segments + s, ChordKind::rough_zone);
    for (const uint32_t off : {2u, 4u, small_segments - 2u}) {
      chord(head, edge + (s + off) % small_segments, ChordKind::marginal);
    }
  }
  return valve;
}

}  // namespace mvs::core
