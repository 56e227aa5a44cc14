// Ridges of a skin where its sides meet the flat bands of its rims.
#pragma once

#include <array>
#include <vector>

#include "patient/leaflet_sheet.h"

namespace mvs::core {

// Edges at which the skin turns by more than 60 degrees, in chains longer than ten times its
// thickness: single edges, and steps of voxels, are noise.
struct SkinRidges {
  std::vector<std::array<uint32_t, 2>> along;  // of each vertex inside of a chain, the vertices
                                               // beside it there; of others, `none`
  bool at_rims = false;  // the chains are long enough to be those of annulus and free edge
};
SkinRidges skin_ridges(const LeafletSheet &skin, double thickness);

}  // namespace mvs::core
