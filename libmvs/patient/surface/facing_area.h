// Atrial side of the leaflets that lies close to the atrial side of other tissue, as in coaptation.
#pragma once

#include "patient/leaflet_sheet.h"

namespace mvs::core {

// Share of the area of a sheet whose atrial side has tissue before it, within `reach` (m), the
// atrial side of which faces back: at most 60 degrees from opposite, and seen at most 53 degrees
// from the normal. Normals of the triangles point into the atrium.
double facing_share(const LeafletSheet &sheet, double reach);

}  // namespace mvs::core
