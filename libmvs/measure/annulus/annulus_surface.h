// Surface that spans the annulus: solution of the Laplace equation, the linearised minimal surface.
#pragma once

#include <vector>

#include "measure/annulus/frame.h"

namespace mvs::core {

// Height above the annulus plane that solves the Laplace equation over the projected annulus with
// the annulus as boundary values; linear finite elements on rings that shrink towards the centre.
// The projection should be star-shaped about the origin of the frame, as that of an annulus is;
// where it is not, the first sector that holds a point counts.
class AnnulusSurface {
 public:
  AnnulusSurface(const Frame &frame, const std::vector<Vec3> &rim);

  // Returns the height in m at a point (AP, CC) of the annulus plane; NaN outside the annulus.
  double height(double u, double v) const {
    size_t near = 0;
    return height(u, v, near);
  }
  // The same, fast if the point is near the last one: `near` is the side of the rim that was found.
  double height(double u, double v, size_t &near) const;

  // Returns the area of the surface, m2.
  double area() const;

 private:
  struct Sector {
    double area, toward_a, toward_b;  // twice those of triangles, m2
  };
  Sector sector(size_t k, const Vec3 &p) const;
  size_t sides() const { return rim_.size(); }
  size_t index(size_t ring, size_t k) const;  // of a height; ring 0 is the centre
  Vec3 point(size_t ring, size_t k) const;
  void solve();
  bool winds_once() const;
  bool is_strictly_towards(size_t k, const Vec3 &p) const;
  size_t find_side(const Vec3 &p, size_t near) const;

  std::vector<Vec3> rim_;  // in the frame, counter-clockwise
  std::vector<double> height_;
  bool star_shaped_ = false;  // the sectors of the sides, seen from the centre, do not overlap
};

}  // namespace mvs::core
