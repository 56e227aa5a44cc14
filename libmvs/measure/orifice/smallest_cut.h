// Minimum cut between atrium and ventricle in the Delaunay tetrahedra of the samples.
#pragma once

#include <vector>

#include "geometry/triangle_bvh.h"
#include "measure/orifice/samples.h"

namespace mvs::core::orifice {

// Returns the triangles of least area that close the valve, as indices of `samples`; empty for a
// sealed valve. `tree`: of the sheet.
std::vector<Tri> smallest_cut(const Sheet &sheet, const TriangleBvh &tree, const Samples &samples);

}  // namespace mvs::core::orifice
