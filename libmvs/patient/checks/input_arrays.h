// Checks of the arrays of a build, before any of their numbers is used.
#pragma once

#include "patient/patient_surface.h"

namespace mvs::core {

// Throws MVS_E_OP unless each corner of each triangle is one of the points, and that point is
// finite and within 1000 km of the origin, so that no product of lengths overflows. The names of
// both arrays are for the sentence.
void check_triangles(const std::vector<Vec3> &points, const std::vector<Tri> &triangles,
                     const char *points_name, const char *triangles_name);

// The same for the closed leaflets, and for the points of all landmarks; checks how many
// commissures and anterior points there are. The leaflets themselves are checked by
// clean_surface().
void check_landmarks(const PatientSurface &surface);

}  // namespace mvs::core
