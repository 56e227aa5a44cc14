// Findings of a fit of chordae to a closed surface.
#pragma once

#include "patient/fit/fit_to_closed.h"

namespace mvs::core {

// The distance that remains; factors of groups; of each chord its factor and how far the surface
// leaves it open; the spread over fits that are as good.
void report_fit(const ChordFit &fit, const FitSettings &settings, Findings &findings);

}  // namespace mvs::core
