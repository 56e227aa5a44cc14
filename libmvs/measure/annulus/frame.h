// The valve's own frame.
#pragma once

#include <vector>

#include "model/model.h"

namespace mvs::core {

// The valve's frame: rows of `axes` are AP (towards the anterior leaflet), CC, and the axis into
// the atrium; right-handed. It turns with the valve.
struct Frame {
  Vec3 origin;  // annulus centroid (by arc length)
  Mat3 axes;

  Vec3 local(const Vec3 &p) const { return axes * (p - origin); }
};
Frame valve_frame(const Model &model, const std::vector<Vec3> &x);

}  // namespace mvs::core
