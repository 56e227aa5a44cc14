// Surface that spans the annulus: solution of the Laplace equation, the linearised minimal surface.
#pragma once

#include <vector>

#include "measure/annulus/frame.h"

namespace mvs::core {

// Height above the annulus plane that solves the Laplace equation over the projected annulus with
// the annulus as boundary values; linear finite elements on rings that shrink towards the centre.
// The projection must be star-shaped about the origin of the frame, which holds for any annulus.
class AnnulusSurface {
 public:
  AnnulusSurface(const Frame &frame, const std::vector<Vec3> &rim);

  // Returns the height in m at a point (AP, CC) of the annulus plane; NaN outside the annulus.
  double height(double u, double v) const;

  // Returns the area of the surface, m2.
  double area() const;

 private:
  size_t sides() const { return rim_.size(); }
  size_t index(size_t ring, size_t k) const;  // of a height; ring 0 is the centre
  Vec3 point(size_t ring, size_t k) const;
  void solve();

  std::vector<Vec3> rim_;  // in the frame, counter-clockwise
  std::vector<double> height_;
};

}  // namespace mvs::core
