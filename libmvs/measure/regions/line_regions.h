// Coaptation length of each region: the coaptation line distributed to the tissue beside it.
#pragma once

#include <vector>

#include "measure/coaptation/coaptation.h"
#include "measure/regions/region_map.h"
#include "measure/regions/regions.h"

namespace mvs::core {

// Sets mean and least coaptation length of each region from places along the coaptation lines. A
// place belongs to a region of each leaflet by a share from 0 to 1, linear in the difference of its
// distances from the region and from the rest of the leaflet: a place as near to one as to the
// other belongs to both by halves, so that the results are continuous in the positions.
void add_coaptation_lengths(const Model &model, const std::vector<Vec3> &x, const RegionMap &map,
                            const Coaptation &coaptation, std::vector<RegionMeasures> &measures);

}  // namespace mvs::core
