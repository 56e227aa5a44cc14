// Coaptation line through samples of the coaptation zone, with the coaptation length along it.
#pragma once

#include <array>
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
  std::vector<CoaptationStation> profile;           // the same at 101 places, whatever the length
  std::array<uint32_t, 2> leaflets = {none, none};  // that meet there; the caller knows them
  double area = 0, length = 0;                      // m2 of one side, m
  // Extremes of the coaptation length along the line, but for 5 % of it at either end.
  double shortest = 0, longest = 0;
};

// Fits a smooth curve through the middle of the pieces and returns, at stations about `spacing`
// apart, the tissue area per length of curve: the coaptation length, measured along the tissue
// whatever its tilt or bend. The line bulges away from the pole. The outermost 0.5 % of the area at
// either end is left out. `pieces` must not be empty. All but the number of stations is continuous
// in the pieces: what is measured along the line is measured along the profile.
CoaptationLine find_coaptation_line(const std::vector<CoaptedPiece> &pieces, const Vec3 &pole,
                                    const Vec3 &axis, double spacing);

}  // namespace mvs::core
