// Pieces of closed leaflets: skins, and sheets.
#pragma once

#include <vector>

#include "patient/fit/surface_match.h"
#include "patient/leaflet_sheet.h"

namespace mvs::core {

// `others`: pieces that are sheets. Skins have no rims, or those of small holes.
struct ClosedBodies {
  std::vector<LeafletSheet> bodies;  // skins, with normals out of the tissue
  ClosedSurface others;
};
// Equal points become one vertex. Bodies with less than a twentieth of the area are left out:
// noise, or gaps inside of a skin.
ClosedBodies closed_bodies(const ClosedSurface &given);

}  // namespace mvs::core
