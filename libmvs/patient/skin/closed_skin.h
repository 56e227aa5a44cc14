// Closed leaflets that are given as a skin, as segmentations are.
#pragma once

#include "patient/fit/surface_match.h"
#include "patient/leaflet_sheet.h"

namespace mvs::core {

// Replaces those pieces of closed leaflets that are skins (both sides of the tissue, without rims)
// by their middle: the atrial side moved inward by half the thickness, and where leaflets touch and
// are one body, whose atrial sides are hidden, the ventricular sides moved inward by a quarter of
// that of both. Triangles of both get normals into the atrium; bands at the rims are dropped.
// An atrial side is seen along `into_atrium` more than the one behind it. Adds the finding
// "closed_skin" if there was a skin. Throws if no side of it is seen from the atrium.
ClosedSurface mid_of_closed(const ClosedSurface &given, const Vec3 &into_atrium,
                            Findings &findings);

}  // namespace mvs::core
