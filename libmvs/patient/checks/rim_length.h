// The length of the annulus beside that of a smooth curve along it.
#pragma once

#include "patient/leaflet_sheet.h"

namespace mvs::core {

// m: the length of the Fourier series of six waves a lap that is next to a closed polygon, by its
// arc length. It keeps the saddle and the D shape of an annulus, and no notches and noise.
double smooth_length(const std::vector<Vec3> &polygon);

// Adds the doubtful finding "annulus_length" where the annulus is longer than a smooth curve along
// it, as where it is torn or noisy, and lowers the confidence in the annulus.
void doubt_annulus_length(const LeafletSheet &sheet, const SheetRims &rims, Findings &findings);

}  // namespace mvs::core
