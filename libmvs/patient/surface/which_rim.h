// Which of two boundary loops is the annulus.
#pragma once

#include <vector>

#include "patient/surface/holes.h"
#include "patient/surface/rims.h"

namespace mvs::core {

// Puts the annulus first, and adds the finding of how that was decided.
void order_rims(const LeafletSheet &sheet, const RimLandmarks &landmarks,
                std::vector<RimLoop> &rims, Findings &findings);

}  // namespace mvs::core
