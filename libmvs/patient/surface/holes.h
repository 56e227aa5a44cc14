// Holes of a sheet among its boundary loops.
#pragma once

#include <vector>

#include "patient/surface/boundary.h"

namespace mvs::core {

struct RimLoop {
  std::vector<uint32_t> loop;
  LoopShape shape;
};

// A loop shorter than this share of the longest one is a hole: 20 to 30 mm around, 6 to 10 mm
// across. The free edge of a severe stenosis (1 cm2) is longer, 35 mm.
inline constexpr double hole_share = 0.2;
// m2: a longer loop is a hole if it spans less, as much as a round hole of 7 mm.
inline constexpr double long_hole_area = 40e-6;

// Fills the loops that are holes, the shortest first, and drops them from `rims`, which are sorted,
// the longest first. Holes are loops shorter than a fifth of the longest one, and longer ones that
// span little and lie in one leaflet. The finding is a guess: a hole beside a rim may be a notch or
// a second orifice behind a strand of tissue.
void fill_holes(LeafletSheet &sheet, std::vector<RimLoop> &rims, Findings &findings);

}  // namespace mvs::core
