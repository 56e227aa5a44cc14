// Seams of resections: parts of a free edge whose two sides are sutured to each other.
#pragma once

#include <vector>

#include "model/model.h"

namespace mvs::core {

struct Seams {
  std::vector<uint8_t> inside;    // per node: 1 in a seam, and so no longer free edge
  std::vector<uint32_t> sutures;  // between two nodes inside, of the list of chordae
  // All nodes of each seam: first the one where its sides part, then pair by pair to the free edge.
  std::vector<std::vector<uint32_t>> nodes;
};

// Finds the seams. A seam is a part of a free edge folded onto itself: it starts at the node whose
// two neighbours are sutured to each other and continues pair by pair. The last pair is still free
// edge.
Seams find_seams(const Model &model);

// The leaflet of a seam.
uint32_t leaflet_of_seam(const Model &model, const std::vector<uint32_t> &nodes);

}  // namespace mvs::core
