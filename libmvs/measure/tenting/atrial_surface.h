// Atrial surface: the leaflets seen from the atrium as a raster of heights.
#pragma once

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

  // Height above the surface that spans the annulus; 0 if either is not defined.
  double rise(size_t cell) const {
    const double rise = heights[cell] - map->heights()[cell];
    return std::isfinite(rise) ? rise : 0;
  }
  // The area of a cell inside the annulus, m2.
  double area(size_t cell) const { return map->share(cell) * map->width() * map->depth(); }
};
AtrialSurface atrial_surface(const Model &model, const std::vector<Vec3> &x);

}  // namespace mvs::core
