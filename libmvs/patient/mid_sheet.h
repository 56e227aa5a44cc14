// The mid-surface of a patient's leaflets.
#pragma once

#include "patient/patient_surface.h"
#include "patient/surface/mend_crossings.h"

namespace mvs::core {

// Wound with normals into the atrium, and its rims.
struct MidSheet {
  LeafletSheet sheet;
  SheetRims rims;
};

// Cleans the surface, finds its mid-surface and rims, fills notches of the free edge, separates
// triangles that cross. Throws a sentence for faults that no rule mends.
MidSheet find_mid_sheet(const PatientSurface &surface, const BuildSettings &settings,
                        Findings &findings);

// Separated crossings: the farther points moved, the less sure is the surface there.
Finding crossings_finding(const CrossingReport &report);

}  // namespace mvs::core
