// A leaflet seen from its free edge: how far along it and how far from it a node lies at rest.
#pragma once

#include "surgery/surgery.h"

namespace mvs::core {

// A node near the free edge.
struct EdgeNode {
  uint32_t node = none;
  double along = 0;  // m, along the free edge from the origin, positive towards the CC axis
  double depth = 0;  // m, from the free edge; 0 on it
};

// The leaflet's nodes that are no part of the annulus, ascending. The origin is the place of the
// free edge at `share` (0 to 1, as SheetMap::along) of the scallop. Throws MVS_E_OP where the
// scallop has no free edge.
std::vector<EdgeNode> nodes_from_free_edge(const Surgery &s, uint32_t scallop, double share);

}  // namespace mvs::core
