// Which way a sheet faces: towards the atrium, or into the ventricle.
#pragma once

#include "model/valve.h"
#include "model/winding.h"

namespace mvs::core {

// Where the atrium is: the normal of the annulus loop that points away from the ventricle, unit,
// with the centre of the loop. The ventricle is where the papillary heads are; without heads it is
// where the sheet hangs. Zero where neither tells (a flat sheet). Indices must be in range.
struct AtrialSide {
  Vec3 centre = Vec3::Zero();
  Vec3 axis = Vec3::Zero();
};
AtrialSide atrial_side(const Valve &valve);

// For each component, the vector area of its rim at the annulus, walked along the winding of the
// triangles there. A sheet with normals on one side of its rim has a rim that runs
// counter-clockwise seen from that side, however its walls hang: so this points to the side that
// the component faces.
std::vector<Vec3> faced_areas(const Valve &valve, const std::vector<Side> &sides,
                              const Winding &winding);

}  // namespace mvs::core
