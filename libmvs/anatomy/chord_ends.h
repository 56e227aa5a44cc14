// Where chordae begin and end, through their branch points.
#pragma once

#include <string>
#include <vector>

#include "model/model.h"

namespace mvs::core {

// Names for each chord segment, joined by '+' in the order of the valve; "" without any.
struct ChordEnds {
  std::vector<std::string> heads;     // papillary heads above it
  std::vector<std::string> scallops;  // in which it, or its branches, end
};

// Heads are the roots of the chordae, nodes of the leaflets their ends. A node between scallops
// belongs to the one with most of its triangles, of these to the one with most of their area at
// rest.
ChordEnds find_chord_ends(const Model &model);

}  // namespace mvs::core
