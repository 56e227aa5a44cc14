// Thickness and fibres of a coarse level from those of a fine one.
#pragma once

#include "anatomy/level_map.h"

namespace mvs::core {

// Gives each coarse triangle the mean, weighted by area, of the fine triangles of its scallop that
// have their middle on it; fibres are lines without direction, so it is the principal axis of the
// mean of f f^T. A triangle of the fine level that is still there keeps its own, bit for bit; so
// does one that stands for none. `valve` is the coarse model's, for the result.
void average_tissue(const Model &fine, const LevelMap &map, const Model &coarse, Valve &valve);

}  // namespace mvs::core
