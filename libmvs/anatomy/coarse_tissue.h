// Thickness and fibres of a coarse level from those of a fine one.
#pragma once

#include "anatomy/level_map.h"

namespace mvs::core {

// Sets thickness and fibre of each coarse triangle to the area-weighted mean over the fine
// triangles of its scallop whose centroids lie on it. Fibres are lines without sign, so their mean
// is the principal axis of the mean of f f^T. A triangle that exists on the fine level keeps its
// values bit for bit, as does one without fine triangles. `valve` is the description of the coarse
// model and receives the result.
void average_tissue(const Model &fine, const LevelMap &map, const Model &coarse, Valve &valve);

}  // namespace mvs::core
