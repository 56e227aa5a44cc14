// Isotropic remeshing of a half sheet towards a uniform edge length.
#pragma once

#include "anatomy/sheet.h"

namespace mvs::core {

// Splits long edges, collapses short ones, flips to Delaunay and smooths, repeatedly (Botsch &
// Kobbelt 2004). Vertices stay on the surface and on their curves; lengths are measured in the open
// valve.
void remesh(const Shape &shape, double edge, HalfSheet &sheet);

}  // namespace mvs::core
