// A parametric mitral valve: annulus, two leaflets, two papillary heads, chordae that let it close.
#pragma once

#include <mvs/valve.h>

#include "model/valve.h"

namespace mvs::core {

// Zeros in `desc` take the defaults stated in include/mvs/valve.h; throws MVS_E_ARGUMENT with the
// name of a dimension that no valve can have.
Valve make_parametric_valve(const mvs_parametric_desc &desc);

}  // namespace mvs::core
