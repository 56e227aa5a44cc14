// Which of two boundary loops is the annulus.
#pragma once

#include <vector>

#include "patient/surface/holes.h"
#include "patient/surface/rims.h"

namespace mvs::core {

// How much a rim looks like an annulus: its spanned area, times its roundness (area /
// length^2, the length of chords, which the steps of voxels do not lengthen) over the square of its
// turning, as the free edge has scallops. Annulus over free edge: 2.2 for a parametric valve with a
// saddle of 9 mm, 3.1 for its default, 28 for a real valve by ultrasound, 37 and more for designed
// ones. (Deviations from a plane mislead: a saddle is less plane than many a free edge.)
double annulus_likeness(const LoopShape &shape);

// How many times more like an annulus a rim is than the other one. A rim that spans more than 1.5
// times as much area is never the less likely one.
double annulus_odds(const LoopShape &rim, const LoopShape &other);

// Puts the annulus first, and adds the finding of how that was decided.
void order_rims(const LeafletSheet &sheet, const RimLandmarks &landmarks,
                std::vector<RimLoop> &rims, Findings &findings);

}  // namespace mvs::core
