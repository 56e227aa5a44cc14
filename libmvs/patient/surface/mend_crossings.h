// Removes crossings of triangles from a sheet by small moves.
#pragma once

#include "patient/leaflet_sheet.h"

namespace mvs::core {

struct CrossingReport {
  size_t before = 0, after = 0;  // pairs of triangles that cross (find_intersections)
  double largest_move = 0;       // m, of a vertex
};

// Flips edges where that alone removes crossings; then, in rounds, smooths the surface around
// crossings of neighbours and pushes walls apart that are far from each other along the surface, in
// patches that grow while crossings remain. Vertices on rims move along them only. A sheet without
// crossings is not changed. Keeps the state with the fewest crossings: the caller refuses a sheet
// with `after` > 0. The same input gives the same bits.
CrossingReport mend_crossings(LeafletSheet &sheet, const SheetRims &rims);

}  // namespace mvs::core
