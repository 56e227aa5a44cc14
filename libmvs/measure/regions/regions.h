// Coaptation, orifice, billow and tenting of each scallop and commissure.
#pragma once

#include <string>
#include <vector>

#include "measure/coaptation/coaptation.h"
#include "measure/regions/orifice_parts.h"
#include "measure/regions/region_map.h"
#include "measure/tenting/atrial_surface.h"

namespace mvs::core {

struct RegionMeasures {
  double coaptation_area = 0;                                    // m2, of one side
  double coaptation_length_mean = 0, coaptation_length_min = 0;  // m
  double orifice_area = 0, gap = 0;                              // m2, m
  double billow_height = 0, billow_volume = 0;                   // m, m3
  double tenting_height = 0, tenting_volume = 0;                 // m, m3
};

// Measures each region of the map. Areas and volumes of the scallops add up to those of the valve.
std::vector<RegionMeasures> measure_regions(const Model &model, const std::vector<Vec3> &x,
                                            const RegionMap &map, const Coaptation &coaptation,
                                            const OrificeParts &orifice,
                                            const AtrialSurface &atrial);

}  // namespace mvs::core
