// Height field of the leaflets seen from the atrium: highest point along the valve axis.
#pragma once

#include <vector>

#include "measure/annulus/frame.h"

namespace mvs::core {

class HeightField {
 public:
  HeightField(const Frame &frame, const std::vector<Tri> &triangles, const std::vector<Vec3> &x);

  struct Top {
    uint32_t triangle = none;  // none without a leaflet
    double height = 0;         // m over the annulus plane
  };
  // Returns the highest leaflet point over a point (AP, CC) of the annulus plane.
  Top top(double u, double v) const;

 private:
  size_t cell(size_t axis, double value) const;  // column or row, within the grid
  void list_triangles();

  const std::vector<Tri> &triangles_;
  std::vector<Vec3> x_;  // in the frame
  std::array<double, 2> low_{}, step_{};
  size_t cells_ = 1;  // to a side
  Rows rows_;         // triangles by cell
};

}  // namespace mvs::core
