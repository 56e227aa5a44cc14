// Leaflets and scallops of a mitral valve by their names.
#pragma once

#include "model/valve.h"

namespace mvs::core {

// Adds the leaflets A and P of one tissue (m; default constants of the law), and the scallops A1 to
// A3 and P1 to P3.
void name_leaflets(LeafletLawId law, double thickness, Valve &valve);

}  // namespace mvs::core
