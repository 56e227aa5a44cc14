// Constitutive laws of chordae: nominal stress over engineering strain; zero in compression.
#pragma once

#include <span>

#include "model/valve.h"

namespace mvs::core {

// Response at one strain: energy per rest volume in J/m3, nominal stress in Pa and its derivative.
struct Axial {
  double energy = 0, stress = 0, slope = 0;
};

struct ChordLaw {
  ChordLawId id;
  const char *word, *name;
  std::span<const Constant> constants;
};

std::span<const ChordLaw> chord_laws();         // in the order of their ids, from 1
const ChordLaw *find_chord_law(ChordLawId id);  // null if unknown

// Requires a known law and valid constants (check_parts.cpp).
Axial chord_response(const Valve &valve, const Chord &chord, double strain);

// Tension in N.
inline double chord_tension(const Valve &valve, const Chord &chord, double strain) {
  return chord.area * chord_response(valve, chord, strain).stress;
}

}  // namespace mvs::core
