// Coordinates of leaflet nodes relative to the free edge at rest: arc length along it and distance
// from it.
#pragma once

#include "surgery/surgery.h"

namespace mvs::core {

// A node near the free edge.
struct EdgeNode {
  uint32_t node = none;
  double along = 0;  // m, along the free edge from the origin, positive towards the CC axis
  double depth = 0;  // m, from the free edge; 0 on it
};

// Returns the nodes of the leaflet except those of the annulus, ascending. The origin is the point
// of the free edge at `share` (0 to 1, as SheetMap::along) of the scallop. Throws MVS_E_OP if the
// scallop has no free edge.
std::vector<EdgeNode> nodes_from_free_edge(const Surgery &s, uint32_t scallop, double share);

}  // namespace mvs::core
