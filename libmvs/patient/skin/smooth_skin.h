// Steps, noise and jagged rims of fine surfaces.
#pragma once

#include "patient/skin/skin_ridges.h"

namespace mvs::core {

// Removes the steps and the noise of a closed skin whose triangles are smaller than the tissue is
// thick, by Taubin's filter (1995), which keeps the volume. Waves shorter than about one and a half
// thicknesses go. Vertices of ridges at rims are filtered along these, so that they stay sharp.
// Returns the number of its rounds, 0 for a coarse or smooth skin, whose rims it would only round
// off.
int smooth_skin(LeafletSheet &skin, double thickness, const SkinRidges &ridges, Findings &findings);

// Moves vertices of the boundary towards the middle of their neighbours along it, `rounds` times,
// where no triangle turns over.
void smooth_rims(LeafletSheet &sheet, int rounds);

}  // namespace mvs::core
