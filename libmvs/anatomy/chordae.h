// Where chordae attach, how they fan out from the papillary tips, and how long they are.
#pragma once

#include <vector>

#include "anatomy/sheet.h"
#include "model/valve.h"

namespace mvs::core {

// A vertex of the half sheet that a chord holds, and why.
struct Attachment {
  uint32_t vertex;
  uint32_t kind;  // MVS_CHORD_KIND_*
  uint32_t tip;   // of its papillary muscle
};

// Chordae of one muscle that spring from one stem; a stem of one is a plain chord.
using Tree = std::vector<Attachment>;

// The trees of the posteromedial muscle. The places are the same for every mesh; each is given to
// the nearest vertex that is still free.
std::vector<Tree> plan_trees(const Shape &shape, const HalfSheet &sheet, const Dimensions &d);

}  // namespace mvs::core
