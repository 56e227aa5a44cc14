// Flips of edges that remove crossings of triangles.
#pragma once

#include "patient/leaflet_sheet.h"

namespace mvs::core {

// Flips edges of crossing triangles as long as each flip lowers the number of crossing pairs and
// leaves no thinner triangle. Returns the pairs that are left.
std::vector<Edge> flip_crossings(LeafletSheet &sheet, std::vector<Edge> pairs);

}  // namespace mvs::core
