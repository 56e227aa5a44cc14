// The surface that spans the annulus: a soap film, to first order in its slope.
#pragma once

#include <vector>

#include "measure/annulus/frame.h"

namespace mvs::core {

// Heights above the annulus plane that solve Laplace's equation over the projection of the annulus
// and equal it on the rim, by linear finite elements on rings that shrink towards the centre. The
// projection must be star-shaped about the frame's origin, as any annulus is.
class AnnulusSurface {
 public:
  AnnulusSurface(const Frame &frame, const std::vector<Vec3> &rim);

  // The height in m at a point of the annulus plane (AP, CC); NaN outside the annulus.
  double height(double u, double v) const;

  // The area of the surface itself, m2.
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
