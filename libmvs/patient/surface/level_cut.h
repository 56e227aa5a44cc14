// Cuts a sheet along a level of a function.
#pragma once

#include <vector>

#include "patient/leaflet_sheet.h"

namespace mvs::core {

// Keeps the part of a sheet in which a function, linear on each triangle, is negative (marching
// triangles). Triangles that its zero level crosses are divided there: their parts lie in their
// planes, so that no crossing is made. A vertex is taken to lie on the level if that passes it
// within `snap` (below 0.5) of the length of an edge. New vertices follow the others; thickness is
// interpolated, labels are kept. Sets `on_cut` for each vertex of the part kept: whether it lies on
// the level.
LeafletSheet part_below(const LeafletSheet &sheet, std::vector<double> level, double snap,
                        std::vector<uint8_t> &on_cut);

}  // namespace mvs::core
