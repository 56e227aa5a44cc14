// Gathering a stretch of the annulus by sutures.
#pragma once

#include "surgery/leaflet/flat.h"

namespace mvs::core {

// Shortens the annulus by `width` around the point of the sheet `at`, open and under load. What is
// left of the posterior annulus comes forward as it has to; the anterior annulus stays.
void plicate(Surgery &s, const Vec3 &at, double width);

}  // namespace mvs::core
