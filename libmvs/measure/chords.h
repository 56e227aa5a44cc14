// Strain and tension of the chordae, and what they pull on the papillary heads.
#pragma once

#include <vector>

#include "model/model.h"

namespace mvs {

struct ChordMeasures {
  std::vector<double> strain, tension;  // per chord
  std::vector<Vec3> head_force;         // N, per head
  double max_strain = 0, max_tension = 0;
};
ChordMeasures measure_chords(const Model &model, const std::vector<Vec3> &x);

}  // namespace mvs
