// Atrial surface: the leaflets seen from the atrium as a raster of heights.
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "measure/annulus/annulus_map.h"
#include "measure/annulus/frame.h"
#include "model/model.h"

namespace mvs::core {

struct AtrialSurface {
  Frame frame;
  std::vector<Vec3> local;  // nodes in the frame
  std::shared_ptr<const AnnulusMap> map;
  std::vector<double> heights;  // m per cell, over the annulus plane; infinite where undefined
  // m, height of each node of the sheet above the surface that spans the annulus; NaN for other
  // nodes and outside the annulus
  std::vector<double> node_rise;
  // where a ball of the contact thickness comes to rest on the leaflets, its lowest point, the
  // deepest first: exact, while the raster can be wrong by 0.4 mm in a steep crevice
  std::vector<Vec3> lows;

  // m, of the deepest low below the annulus plane; 0 above it.
  double depth() const { return lows.empty() ? 0 : std::max(0.0, -lows.front()[2]); }
  // Height above the surface that spans the annulus; 0 if either is not defined.
  double rise(size_t cell) const {
    const double rise = heights[cell] - map->heights()[cell];
    return std::isfinite(rise) ? rise : 0;
  }
  // m, of a cell below the annulus plane, not above 0: in proportion on the rim, so that no cell
  // enters with its whole depth, and at most that of the deepest low.
  double depth(size_t cell) const {
    if (!std::isfinite(heights[cell])) return 0;
    return std::clamp(-map->share(cell) * heights[cell], 0.0, depth());
  }
  // The area of a cell inside the annulus, m2.
  double area(size_t cell) const { return map->share(cell) * map->width() * map->depth(); }
};
AtrialSurface atrial_surface(const Model &model, const std::vector<Vec3> &x);

}  // namespace mvs::core
