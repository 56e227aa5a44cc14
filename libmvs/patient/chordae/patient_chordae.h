// Chordae of a patient's valve: insertions by anatomy, rest lengths by the closed target.
#pragma once

#include "model/valve.h"
#include "patient/chordae/papillary_tips.h"

namespace mvs::core {

struct ChordaeSettings {
  uint32_t chords = 100;            // about this number of chord segments, 20 to 400
  double chord_factor = 1;          // on all rest lengths, 0.5 to 2
  double coaptation_length = 8e-3;  // m, overlap in the middle that is aimed at, 1 to 20 mm
};

// Adds heads, branch points and chordae. The nodes of `valve` are the vertices of the sheet, in
// order; its annulus is at Valve::loaded if that is not empty. Each leaf of a chord gets the
// length at which its vertex is at its closed target (closed_target.h).
void add_chordae(Valve &valve, const PatientGeometry &g, const PapillaryTips &tips,
                 const ChordaeSettings &settings, Findings &findings);

}  // namespace mvs::core
