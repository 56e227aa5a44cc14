// Grey-scale morphology of a height field with a ball.
#pragma once

#include <vector>

#include "measure/annulus/annulus_map.h"

namespace mvs::core {

// One step of a morphological closing over the inside of the annulus: with sign +1, the height at
// which a ball rests on the heights; with -1, the lowest points of balls with these centres.
// -infinity outside of the annulus. Cells on the rim count in proportion to their share inside:
// they are lower (higher with -1) by up to the diameter, so that the result is continuous in the
// annulus.
std::vector<double> roll_ball(const AnnulusMap &map, const std::vector<double> &heights,
                              double radius, double sign);

}  // namespace mvs::core
