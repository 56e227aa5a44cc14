// Triangles over a hole of a sheet.
#pragma once

#include <vector>

#include "patient/leaflet_sheet.h"

namespace mvs::core {

// Closes a boundary loop (in the order in which the triangles pass along it) by the triangulation
// with the least area (Barequet & Sharir 1995: dynamic programming, n^3 / 6 triangles for n
// vertices); long sides in it are then halved down to about the mean length of the loop's sides,
// flipped to Delaunay, and new vertices go to the mean of their neighbours. New triangles have the
// label of the nearest side of the loop, new vertices the mean thickness of their neighbours.
// Returns the number of new triangles.
size_t fill_hole(LeafletSheet &sheet, const std::vector<uint32_t> &loop);

}  // namespace mvs::core
