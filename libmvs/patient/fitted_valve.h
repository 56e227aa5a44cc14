// A patient's valve whose tissue and chordae follow from the closed leaflets.
#pragma once

#include "patient/fit/fit_to_closed.h"
#include "patient/patient_valve.h"

namespace mvs::core {

// A patient's leaflets on their mid-surface, with the landmarks that the meshes of all sizes share.
struct Patient {
  const MidSheet &mid;
  const Boundary &boundary;
  const ClosedSurface &closed;
};

// A valve with the geometry that its fit may have changed, and all findings.
struct FittedValve {
  LeafletLawId law;
  PatientGeometry g;
  Valve valve;
  Findings findings;
  ChordFit fit;
  std::vector<double>
      leaks;  // m2, of coarse fits with plausible laws, then of fits as good as this
};

// The law that is given, or that of coarse fits (fitted_law.h); the tissue that the closed surface
// shows past a free edge that is not exact; fitted lengths. `tell` is called with the share that is
// done and may throw.
FittedValve fitted_valve(const Patient &patient, const BuildSettings &settings,
                         const PatientGeometry &g, const Findings &findings, const TellShare &tell);

// The finding "tissue" of a law that is given.
Finding given_tissue(LeafletLawId law);

}  // namespace mvs::core
