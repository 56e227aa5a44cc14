// Holes of a skin, which has to be closed.
#pragma once

#include "patient/leaflet_sheet.h"

namespace mvs::core {

// Fills the boundary loops of a skin with small holes, such as segmentations and decimation leave
// them, and adds a finding. A surface is such a skin if the square of its longest loop is below its
// area: a disc has 12 times its area, and a sheet with two rims more. Others are left as they are.
// Throws if a hole of a skin is more than 20 mm around.
void fill_skin_holes(LeafletSheet &sheet, Findings &findings);

}  // namespace mvs::core
