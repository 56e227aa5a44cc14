// Height and depth of coaptation in sections along the central AP plane.
#pragma once

#include <vector>

#include "measure/coaptation/coaptation.h"
#include "measure/coaptation/facing_weight.h"

namespace mvs::core {

// Sets height and depth from five sections of the leaflets with planes within one contact thickness
// of the central AP plane. `local` are the nodes in the frame of the valve. Leaves gathered tissue
// out of `facing`.
void measure_central_section(const Model &model, const std::vector<Vec3> &local,
                             const std::vector<Vec3> &x, FacingWeight &facing,
                             Coaptation &coaptation);

}  // namespace mvs::core
