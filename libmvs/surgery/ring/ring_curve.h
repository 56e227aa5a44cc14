// Curve of an annuloplasty ring: a parametric one, and the validity of any curve.
#pragma once

#include "measure/annulus/landmarks.h"

namespace mvs::core {

// Returns a ring with the proportions of the Physio II 34, scaled to these sizes in m: from its A
// point towards the positive CC axis. Axes are AP, CC, into the atrium; the centroid (by arc
// length) is the origin.
std::vector<Vec3> parametric_ring(double width, double ap, double saddle);

// Returns the extent of a closed curve along its principal axes, largest first.
Vec3 extent_of(const Loop &curve);

// Returns a closed curve without its last point if that repeats the first, as VTK and Slicer write.
std::vector<Vec3> without_repeated_start(std::vector<Vec3> curve);

// Throws MVS_E_ARGUMENT with the name of the operation for an invalid ring: coincident points,
// implausible size, a slit, or a curve that crosses itself.
void must_be_a_ring(const char *op_name, const std::vector<Vec3> &curve);

}  // namespace mvs::core
