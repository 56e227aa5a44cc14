// Holes of a sheet among its boundary loops.
#pragma once

#include <cmath>
#include <vector>

#include "patient/surface/boundary.h"

namespace mvs::core {

// A loop shorter than this share of the longest one is a hole: 20 to 30 mm around, 6 to 10 mm
// across. The free edge of a severe stenosis (1 cm2) is longer, 35 mm.
inline constexpr double hole_share = 0.2;
// m2: a longer loop is a hole if it spans less, as much as a round hole of 7 mm.
inline constexpr double long_hole_area = 40e-6;

// Holes that were filled, for one finding.
struct FilledHoles {
  std::vector<double> lengths;  // m, around each
  size_t triangles = 0, doubtful = 0;
  double nearest = INFINITY;  // m, of a hole from a rim
  double confidence = 0.9;
};

// Fills the loops that are holes, the shortest first, drops them from `rims`, which are sorted, the
// longest first, and adds them to `filled`. Holes are loops shorter than a fifth of the longest
// one, and longer ones that span little and lie in one leaflet.
void fill_holes(LeafletSheet &sheet, std::vector<RimLoop> &rims, FilledHoles &filled);

// The finding, if there were holes. It is a guess: a hole beside a rim may be a notch or a second
// orifice behind a strand of tissue.
void report_holes(const FilledHoles &filled, Findings &findings);

}  // namespace mvs::core
