// Noise of a surface, which makes its leaflets too large.
#pragma once

#include "patient/leaflet_sheet.h"

namespace mvs::core {

// Adds the doubtful finding "rough_surface" where the surface turns by more than 40 degrees across
// half of its edges, as with noise of a quarter of an edge; its area is 5 % too large then. Sound
// surfaces turn by less than 10 degrees.
void doubt_rough_surface(const LeafletSheet &sheet, Findings &findings);

}  // namespace mvs::core
