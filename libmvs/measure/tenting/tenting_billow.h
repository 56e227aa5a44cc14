// Tenting and billow: depth of the leaflets below the annulus surface, and height above it.
#pragma once

#include "measure/tenting/atrial_surface.h"

namespace mvs::core {

struct TentingBillow {
  double tenting_height = 0, tenting_area = 0, tenting_volume = 0, billow_height = 0,
         billow_volume = 0;
};
TentingBillow measure_tenting_billow(const AtrialSurface &atrial);
inline TentingBillow measure_tenting_billow(const Model &model, const std::vector<Vec3> &x) {
  return measure_tenting_billow(atrial_surface(model, x));
}

}  // namespace mvs::core
