// Making the cut that closes the valve a smooth surface of least area.
#pragma once

#include <vector>

#include "measure/orifice/samples.h"

namespace mvs::core::orifice {

// Lets the cut shrink: its rim slides along the sheet (where it crosses a closed passage it stays),
// the rest is free.
Mesh smallest_surface(const Sheet &sheet, const Samples &samples, const std::vector<Tri> &cut);

}  // namespace mvs::core::orifice
