// Relaxation of the minimum cut to a smooth surface of least area.
#pragma once

#include <vector>

#include "geometry/triangle_bvh.h"
#include "measure/orifice/samples.h"

namespace mvs::core::orifice {

// Minimises the area of the cut: nodes of its rim slide along the sheet, or stay where the rim
// crosses a sealed passage; inner nodes are free. `tree`: of the sheet.
Mesh smallest_surface(const Sheet &sheet, const TriangleBvh &tree, const Samples &samples,
                      const std::vector<Tri> &cut);

}  // namespace mvs::core::orifice
