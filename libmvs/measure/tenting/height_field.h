// Height field of the leaflets seen from the atrium: highest point along the valve axis.
#pragma once

#include <vector>

#include "measure/annulus/annulus_map.h"

namespace mvs::core {

// Returns, per cell of the map, the height over the annulus plane of the highest leaflet point over
// its centre; -infinity without a leaflet, and outside the annulus. `local` are the nodes in the
// frame of the map.
std::vector<double> highest_leaflet(const AnnulusMap &map, const std::vector<Tri> &triangles,
                                    const std::vector<Vec3> &local);

// One step of a morphological closing over the inside of the annulus: with sign +1, the height at
// which a ball rests on the heights; with -1, the lowest points of balls with these centres.
// -infinity outside of the annulus.
std::vector<double> roll_ball(const AnnulusMap &map, const std::vector<double> &heights,
                              double radius, double sign);

}  // namespace mvs::core
