// A closed curve through points of an annulus.
#pragma once

#include <vector>

#include "base/types.h"

namespace mvs::core {

// Points of a curve around the annulus, about `spacing` apart, through the given points in any
// order (centripetal Catmull-Rom spline, Yuksel et al. 2011): they are sorted by the angle around
// the axis along which they spread least, and those within 2.5 mm of each other are averaged. Empty
// if fewer than six points are left, or if they leave a third of the way around open.
std::vector<Vec3> annulus_through(const std::vector<Vec3> &points, double spacing);

}  // namespace mvs::core
