// Strain and tension of the chordae, and the resultant forces on the papillary heads.
#pragma once

#include <vector>

#include "model/model.h"

namespace mvs::core {

// Limits of the working range of a kind of chord; DEFINITIONS.md has the sources.
struct ChordLimits {
  double strain, tension;  // 1, N
};
ChordLimits chord_limits(ChordKind kind);

struct ChordMeasures {
  std::vector<double> strain, tension;         // per chord
  std::vector<uint8_t> flags;                  // per chord: MVS_CHORD_FLAG_OVER_*
  uint32_t over_strain = 0, over_tension = 0;  // number of chordae
  std::vector<Vec3> head_force;                // N, per head
  double max_strain = 0, max_tension = 0;
};
ChordMeasures measure_chords(const Model &model, const std::vector<Vec3> &x);

}  // namespace mvs::core
