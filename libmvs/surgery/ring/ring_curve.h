// The curve of an annuloplasty ring: a parametric one, and what any curve has to be.
#pragma once

#include "measure/annulus/landmarks.h"

namespace mvs::core {

// A ring of the proportions of the Physio II 34, stretched to these sizes in m: from its A point on
// towards the positive CC axis. Axes are AP, CC, into the atrium; the centroid (by arc length) is
// the origin.
std::vector<Vec3> parametric_ring(double width, double ap, double saddle);

// The extent of a closed curve along the axes of its own second moments, longest first.
Vec3 extent_of(const Loop &curve);

// Throws MVS_E_ARGUMENT, in the name of the operation, for points that are no ring: some at the
// same place, too small or too large for a valve, a slit, or a curve that crosses itself.
void must_be_a_ring(const char *op_name, const std::vector<Vec3> &curve);

}  // namespace mvs::core
