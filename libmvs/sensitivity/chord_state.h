// A chord at given positions: direction, length, strain, and the response of its law.
#pragma once

#include "model/chord_law.h"
#include "model/model.h"

namespace mvs::core {

struct ChordState {
  Vec3 along;  // unit, from a to b
  double length, strain;
  Axial response;
};

inline ChordState chord_state(const Valve &valve, const Chord &chord, const Vec3 &a,
                              const Vec3 &b) {
  const Vec3 d = b - a;
  const double length = d.norm(), strain = length / chord.rest_length - 1;
  return {d / length, length, strain, chord_response(valve, chord, strain)};
}

inline ChordState chord_state(const Model &model, uint32_t index, const std::vector<Vec3> &x) {
  const Chord &chord = model.valve.chords[index];
  return chord_state(model.valve, chord, x[chord.a], x[chord.b]);
}

}  // namespace mvs::core
