// Gaps whose mouth is a single point.
#pragma once

#include "patient/leaflet_sheet.h"

namespace mvs::core {

// Fills the gaps beside a rim that open to it in one point, where the tissue of both sides touches.
// clean_surface() gives each side a vertex of its own there, so that the rim passes that place
// twice, around the gap in between. Such gaps are holes by their length (hole_share): both vertices
// become one, and the gap is filled. As a notch it has a mouth without direction, and filling a
// part of it leaves a slit without width: two sides that touch at rest, where contact, whose range
// follows the distance at rest, cannot push them apart. `sheet` is one piece as clean_surface()
// makes it.
void fill_pinched_gaps(LeafletSheet &sheet, Findings &findings);

}  // namespace mvs::core
