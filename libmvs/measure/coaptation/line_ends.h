// Ends of a line: where the outermost area of its pieces ends.
#pragma once

#include <vector>

#include "measure/coaptation/piece_curve.h"

namespace mvs::core {

// Sorts pieces by parameter and removes the outermost share of their area; returns where the rest
// begins and ends. Both ends are continuous in the pieces. An end is a quantile of the area, as
// long as pieces lie close to each other there. Beyond a gap, where a quantile jumps from one side
// to the other, a part of the line begins with its nearest end when it has the share of area that
// is removed, and is reached in full with at most twice that share.
OrderSpan trim(std::vector<OrderedPiece> &pieces);

}  // namespace mvs::core
