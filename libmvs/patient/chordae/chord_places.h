// Where chordae insert on a patient's leaflets, and which of them share a trunk.
#pragma once

#include "model/kinds.h"
#include "patient/patient_geometry.h"

namespace mvs::core {

// Leaves of one chord: vertices of the sheet. One leaf is a plain chord.
struct ChordTree {
  ChordKind kind = ChordKind::marginal;
  std::vector<uint32_t> leaves;
};

struct ChordPlan {
  std::vector<ChordTree> anterolateral, posteromedial;
};

// Rows along the free edge, in the rough zone, of struts and of basal chordae, evenly along their
// own length; each muscle serves its half of both leaflets, from the A point over its commissure to
// the P point. About `segments` chord segments, 20 to 400, trunks and leaves alike; fewer where the
// free edge has not three vertices for two marginal chordae. Each place goes to the nearest free
// vertex.
ChordPlan plan_chords(const PatientGeometry &g, uint32_t segments);

}  // namespace mvs::core
