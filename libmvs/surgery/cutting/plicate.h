// Plication: gathers a stretch of the annulus by sutures.
#pragma once

#include "surgery/leaflet/flat.h"

namespace mvs::core {

// Shortens the annulus by `width` around the sheet point `at`, open and under load. The rest of the
// posterior annulus moves forward accordingly; the anterior annulus stays.
void plicate(Surgery &s, const Vec3 &at, double width);

}  // namespace mvs::core
