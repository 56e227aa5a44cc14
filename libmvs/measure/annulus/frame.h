// The valve's own frame.
#pragma once

#include <vector>

#include "model/model.h"

namespace mvs::core {

// Right-handed frame of a valve: rows of `axes` are AP (towards the anterior leaflet), CC, and the
// axis into the atrium. It moves with the valve.
struct Frame {
  Vec3 origin;  // annulus centroid (by arc length)
  Mat3 axes;

  Vec3 local(const Vec3 &p) const { return axes * (p - origin); }
  std::vector<Vec3> local(const std::vector<Vec3> &points) const;
};
Frame valve_frame(const Model &model, const std::vector<Vec3> &x);

// Third component of the cross product of two vectors, from their first two components.
inline double cross_in_plane(const Vec3 &a, const Vec3 &b) {
  return a[0] * b[1] - a[1] * b[0];
}

}  // namespace mvs::core
