// Orientation of a sheet relative to the atrium.
#pragma once

#include "model/valve.h"
#include "model/winding.h"

namespace mvs::core {

// Mean of the annulus nodes at rest.
Vec3 annulus_centre(const Valve &valve);

// Vector area of the annulus loop at rest about its centre, m2; it points along the valve's axis or
// against it.
Vec3 annulus_area(const Valve &valve, const Vec3 &centre);

// The unit normal of the annulus loop that points away from the ventricle, and the centre of the
// loop. The ventricle is on the side of the papillary heads or, without heads, on the side of the
// sheet. The axis is zero if neither decides (a flat sheet). Indices must be in range.
struct AtrialSide {
  Vec3 centre = Vec3::Zero();
  Vec3 axis = Vec3::Zero();
};
AtrialSide atrial_side(const Valve &valve);

// Returns, for each component of the sheet, the vector area of its rim at the annulus, traversed in
// the winding of the triangles there. The rim of a sheet runs counter-clockwise seen from the side
// of its normals, whatever the shape of its walls: so the vector points to the side that the
// component faces.
std::vector<Vec3> faced_areas(const Valve &valve, const std::vector<Side> &sides,
                              const Winding &winding);

}  // namespace mvs::core
