// Mid-surfaces of leaflets whose surface is their atrial side, or both sides.
#pragma once

#include "patient/leaflet_sheet.h"
#include "patient/surface/rims.h"

namespace mvs::core {

// Moves a sheet from the atrial side of the tissue to its middle: each vertex by half the thickness
// there (m; `thickness_if_unknown` where the sheet has none) against the normals, which point into
// the atrium (find_rims() turns them so). Moves less where triangles would turn over or cross
// others.
void move_to_mid(LeafletSheet &sheet, double thickness_if_unknown, Findings &findings);

// Drops the triangles at the rims of the atrial side of a skin that bend around the edge of the
// tissue: moved to the middle, they would shrink to less than a half or cross others. The middle of
// tissue with a round edge ends half a thickness before it. Changes nothing if parts of the sheet
// would be lost.
void drop_round_rims(LeafletSheet &sheet);

// The mid-surface of a closed skin (both sides of the leaflets and the bands that join them at
// annulus and free edge) as an open sheet with normals into the atrium and with the thickness at
// each vertex. Rays inward from each triangle measure the thickness (shape diameter, Shapira et al.
// 2008); triangles that face a parallel one form the two sides; the atrial one moves half-way to
// the other. Throws if the skin does not split into two sides with two rims each. `skin` is one
// piece as clean_surface() makes it, without holes (fill_skin_holes()).
LeafletSheet mid_of_skin(const LeafletSheet &skin, const RimLandmarks &landmarks,
                         Findings &findings);

}  // namespace mvs::core
