// Harmonic function on a sheet with given values at some vertices.
#pragma once

#include <cstdint>
#include <vector>

#include "patient/leaflet_sheet.h"

namespace mvs::core {

// Sets the values of the vertices that are not `held`. The function has no extremum at these.
void make_harmonic(const LeafletSheet &sheet, const std::vector<uint8_t> &held,
                   std::vector<double> &u);

}  // namespace mvs::core
