// The line along which leaflets meet, found from the places where they do.
#pragma once

#include <vector>

#include "measure/coaptation/coaptation.h"

namespace mvs::core {

// A piece of the coaptation zone, midway between the leaflets.
struct CoaptedPiece {
  Vec3 middle;
  Vec3 normal;  // from one leaflet to the other, of any length
  double area;  // m2 of one side
};

struct CoaptationLine {
  std::vector<CoaptationStation> stations;
  double spacing = 0;  // m between stations
};

// A smooth curve through the middle of the pieces, and the area of tissue per length of that curve
// at stations about `spacing` apart: the coaptation length there, measured along the tissue
// whatever its tilt or bend. The pole is a point that the line does not bulge towards; the
// outermost 0.5 % of the area at either end is left out. There must be at least one piece.
CoaptationLine find_coaptation_line(const std::vector<CoaptedPiece> &pieces, const Vec3 &pole,
                                    const Vec3 &axis, double spacing);

}  // namespace mvs::core
