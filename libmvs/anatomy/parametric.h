// Parametric mitral valve: annulus, two leaflets, two papillary muscles, chordae that permit
// closure.
#pragma once

#include <mvs/valve.h>

#include "model/valve.h"

namespace mvs::core {

// Zeros in `desc` stand for the defaults of include/mvs/valve.h. Throws MVS_E_ARGUMENT with the
// name of an invalid dimension.
Valve make_parametric_valve(const mvs_parametric_desc &desc);

}  // namespace mvs::core
