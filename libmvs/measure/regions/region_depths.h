// Tenting height of regions: the deepest place of the atrial surface near the tissue of each.
#pragma once

#include <vector>

#include "geometry/triangle_bvh.h"
#include "measure/regions/region_map.h"
#include "measure/tenting/atrial_surface.h"

namespace mvs::core {

// Raises `deepest`, one per region, to the largest of depth times share over all cells and lows of
// the atrial surface. The share of a cell in a region falls with how much further the cell is from
// the region's tissue than from the nearest: from 1 at a quarter of `thickness` to 0 at three
// quarters. So the bottom of the crevice between two leaflets belongs to both, and the result is
// continuous in the positions. `deepest` may begin with values of some cells: fewer are looked at
// then.
void raise_depths(const AtrialSurface &atrial, const RegionMap &map, const TriangleBvh &tree,
                  double thickness, std::vector<double> &deepest);

}  // namespace mvs::core
