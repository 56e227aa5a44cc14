// Leaflets that are too tall: wall of the atrium or the aorta that the surface has above the
// annulus.
#pragma once

#include "patient/leaflets.h"

namespace mvs::core {

// Where the annulus was not given: adds the finding "tall_leaflets" and halves the confidence in
// the annulus if the leaflets are a third taller than the largest normal ones all around both
// commissures, thick ones by twice that thickness more, or in the anterior leaflet, or if given
// commissures lie below the annulus. Wall beside P2 alone is not seen so: tall scallops of
// Barlow's disease look the same.
void doubt_tall_leaflets(const LeafletSheet &sheet, const SheetRims &rims,
                         const SheetCoordinates &coordinates, const LeafletArcs &arcs,
                         const std::vector<Vec3> &commissures, Findings &findings);

}  // namespace mvs::core
