// Leaflets that lack tissue at the free edge, made as long as the closed surface shows them.
#pragma once

#include "patient/fit/fit_to_closed.h"
#include "patient/patient_geometry.h"

namespace mvs::core {

// Fits the chordae of a copy to the closed surface, and moves the free edge of `valve` and of `g`
// out by what the surface has beyond it (edge_overhang.h), with a finding. Both stay as they are
// where the edge would move by less than a tenth of a millimetre in the mean. Returns by how much
// it was moved, m RMS. `known`: factors from which the fit begins.
double extend_free_edge(Valve &valve, PatientGeometry &g, const ClosedSurface &given,
                        const GroupFactors &known, Findings &findings, const TellShare &tell);

}  // namespace mvs::core
