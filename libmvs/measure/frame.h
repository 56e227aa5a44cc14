// The valve's own frame, and the landmarks of the annulus it rests on.
#pragma once

#include <vector>

#include "model/model.h"

namespace mvs {

// The valve's frame: rows of `axes` are AP (towards the anterior leaflet), CC, and the axis into
// the atrium; right-handed.
struct Frame {
  Vec3 origin;  // annulus centroid (by arc length)
  Mat3 axes;

  Vec3 local(const Vec3 &p) const { return axes * (p - origin); }
};
Frame valve_frame(const Model &model, const std::vector<Vec3> &x);

// Where the anterior leaflet is attached, and what follows from it.
struct Landmarks {
  Vec3 a;                          // middle, by arc length, of the anterior segment of the annulus
  Vec3 p;                          // middle of the rest of the annulus
  std::array<Vec3, 2> commissure;  // where the anterior segment starts and ends
};
Landmarks find_landmarks(const Model &model, const std::vector<Vec3> &x);

}  // namespace mvs
