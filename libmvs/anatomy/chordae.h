// Plan of the chordae of a parametric valve: attachments, branching, papillary tips.
#pragma once

#include <vector>

#include "anatomy/sheet.h"
#include "model/valve.h"

namespace mvs::core {

// A vertex of the half sheet with a chord, and the chord that ends there.
struct Attachment {
  uint32_t vertex;
  ChordKind kind;
  uint32_t tip;  // of its papillary muscle
};

// Chordae of one muscle with a common trunk; a tree of one is a plain chord.
using Tree = std::vector<Attachment>;

// Returns the trees of the posteromedial muscle. The target places do not depend on the mesh; each
// is assigned to the nearest free vertex.
std::vector<Tree> plan_trees(const Shape &shape, const HalfSheet &sheet, const Dimensions &d);

}  // namespace mvs::core
