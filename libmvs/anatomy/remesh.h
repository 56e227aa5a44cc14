// Isotropic remeshing of a sheet: every edge about the same length, every triangle about
// equilateral.
#pragma once

#include "anatomy/sheet.h"

namespace mvs::core {

// Splits long edges, collapses short ones, flips to Delaunay, evens out vertices, over and over
// (Botsch & Kobbelt 2004). Vertices stay on the surface and on their curves; lengths are measured
// in the open valve.
void remesh(const Shape &shape, double edge, HalfSheet &sheet);

}  // namespace mvs::core
