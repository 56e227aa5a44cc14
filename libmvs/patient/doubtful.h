// Whether a finding says that an input of a build is probably wrong.
#pragma once

#include "patient/findings.h"

namespace mvs::core {

// True for findings that contradict the surface or normal anatomy, such as landmarks of another
// frame, swapped leaflets, or wall of the atrium counted as leaflet. Whoever builds should be told.
bool is_doubtful(const Finding &finding);

}  // namespace mvs::core
