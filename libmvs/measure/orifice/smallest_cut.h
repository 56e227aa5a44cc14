// The space around the sheet as tetrahedra, and the smallest cut between atrium and ventricle.
#pragma once

#include <vector>

#include "measure/orifice/samples.h"

namespace mvs::core::orifice {

// Triangles that close the valve at the least area; nodes are those of `samples`. None if sealed.
std::vector<Tri> smallest_cut(const Sheet &sheet, const Samples &samples);

}  // namespace mvs::core::orifice
