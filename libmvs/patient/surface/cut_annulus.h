// Cuts the wall of the atrium off leaflets, along points of the annulus.
#pragma once

#include "patient/surface/rims.h"

namespace mvs::core {

// Drops the tissue beyond a curve through given points of the annulus (annulus_through.h), which is
// moved onto the surface along its normals. The sign of the distance from the curve, along the
// surface and across the curve, is that of the side; the side with the rim that is nearer to the
// papillary tips, or less like an annulus (which_rim.h), and that does not follow the curve, has
// the leaflets.
// Only pieces that reach farther than 2.5 mm beyond the curve are dropped: points by hand err by up
// to 2 mm. Returns whether any was, and adds the finding "atrial_tissue" then, or if the surface
// could not be cut along the points. Triangles are divided in their planes: no crossing is made.
// `sheet` is wound alike; it may have any number of boundary loops.
bool cut_along_annulus(LeafletSheet &sheet, const RimLandmarks &landmarks, Findings &findings);

}  // namespace mvs::core
