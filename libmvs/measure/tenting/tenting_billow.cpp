// Tenting and billow from a raster of the leaflets seen from the atrium, minus the surface that
// spans the annulus.
#include "measure/tenting/tenting_billow.h"

#include <algorithm>
#include <cmath>

#include "measure/tenting/atrial_surface.h"

namespace mvs::core {
namespace {

double area_below(const AtrialSurface &atrial, int row) {
  double sum = 0;
  for (int column = 0; column < AnnulusMap::across; ++column) {
    sum += atrial.map->width() * std::max(0.0, -atrial.rise(AnnulusMap::at(column, row)));
  }
  return sum;
}

// Area below the annulus surface in the central AP plane, interpolated between the adjacent rows.
double central_area_below(const AtrialSurface &atrial) {
  const AnnulusMap &map = *atrial.map;
  const double place = std::clamp(-map.low_v() / map.depth() - 0.5, 0.0, AnnulusMap::across - 2.0);
  const int row = static_cast<int>(place);
  const double share = place - row;
  return (1 - share) * area_below(atrial, row) + share * area_below(atrial, row + 1);
}

}  // namespace

TentingBillow measure_tenting_billow(const Model &model, const std::vector<Vec3> &x) {
  const AtrialSurface atrial = atrial_surface(model, x);
  const AnnulusMap &map = *atrial.map;
  TentingBillow result;
  const double cell = map.width() * map.depth();
  for (size_t c = 0; c < atrial.heights.size(); ++c) {
    if (!map.inside(c)) continue;
    const double rise = atrial.rise(c);
    result.tenting_volume += cell * std::max(0.0, -rise);
    result.billow_volume += cell * std::max(0.0, rise);
    if (std::isfinite(atrial.heights[c])) {
      result.tenting_height = std::max(result.tenting_height, -atrial.heights[c]);
    }
  }
  result.tenting_area = central_area_below(atrial);
  for (const double rise : node_rises(model, atrial)) {
    if (rise > result.billow_height) result.billow_height = rise;  // false for NaN
  }
  return result;
}

}  // namespace mvs::core
