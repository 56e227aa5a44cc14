// Tenting and billow from a raster of the leaflets seen from the atrium, minus the surface that
// spans the annulus.
#include "measure/tenting/tenting_billow.h"

#include <algorithm>
#include <cmath>

namespace mvs::core {
namespace {

double area_below(const AtrialSurface &atrial, int row) {
  double sum = 0;
  for (int column = 0; column < AnnulusMap::across; ++column) {
    const size_t cell = AnnulusMap::at(column, row);
    sum += atrial.map->share(cell) * std::max(0.0, -atrial.rise(cell));
  }
  return atrial.map->width() * sum;
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

TentingBillow measure_tenting_billow(const AtrialSurface &atrial) {
  const AnnulusMap &map = *atrial.map;
  TentingBillow result;
  for (size_t row = 0; row < AnnulusMap::across; ++row) {
    const size_t start = row * AnnulusMap::across;
    for (size_t c = start + map.first_inside(row); c < start + map.end_inside(row); ++c) {
      if (!map.inside(c)) continue;
      const double rise = atrial.rise(c), area = atrial.area(c);
      result.tenting_volume += area * std::max(0.0, -rise);
      result.billow_volume += area * std::max(0.0, rise);
    }
  }
  result.tenting_height = atrial.depth();
  result.tenting_area = central_area_below(atrial);
  for (const double rise : atrial.node_rise) {
    if (rise > result.billow_height) result.billow_height = rise;  // false for NaN
  }
  return result;
}

}  // namespace mvs::core
