// Coaptation line through samples of the coaptation zone, with the coaptation length along it.
#pragma once

#include <vector>

#include "measure/coaptation/coaptation.h"

namespace mvs::core {

// A sample of the coaptation zone, midway between the leaflets.
struct CoaptedPiece {
  Vec3 middle;
  Vec3 normal;  // from one leaflet to the other, of any length
  double area;  // m2 of one side
};

struct CoaptationLine {
  std::vector<CoaptationStation> stations;
  double spacing = 0;  // m between stations
};

// Fits a smooth curve through the middle of the pieces and returns, at stations about `spacing`
// apart, the tissue area per length of curve: the coaptation length, measured along the tissue
// whatever its tilt or bend. The line bulges away from the pole. The outermost 0.5 % of the area at
// either end is left out. `pieces` must not be empty.
CoaptationLine find_coaptation_line(const std::vector<CoaptedPiece> &pieces, const Vec3 &pole,
                                    const Vec3 &axis, double spacing);

}  // namespace mvs::core
