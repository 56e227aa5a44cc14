// Points of a surface that lie far from its other points.
#pragma once

#include "patient/leaflet_sheet.h"

namespace mvs::core {

// Moves each vertex that is the tip of a needle to the mean of its neighbours: one that is farther
// from that mean than four times the farthest neighbour and four median edges. Adds the finding
// "displaced_points". A sound surface keeps its points, also one of long thin triangles, as some of
// the neighbours of each vertex are then as far apart.
void mend_displaced(LeafletSheet &sheet, Findings &findings);

// Adds the doubtful finding "far_tissue" if the surface reaches farther from the middle of its
// annulus than leaflets do.
void doubt_far_tissue(const LeafletSheet &sheet, const SheetRims &rims, Findings &findings);

}  // namespace mvs::core
