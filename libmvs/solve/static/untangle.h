// Removes the few crossings that interpolation from a coarser mesh makes: fine triangles cut the
// corners of folds that coarse triangles follow.
//
// The coarse sheet does not cross itself, so that the places of two fine triangles on it say on
// which side of each other they belong: the difference of their centres there. Both are pushed
// apart along it in small increments until the exact test finds no crossing. Unlike methods for
// cloth without history (Volino & Magnenat-Thalmann, Resolving surface collisions through
// intersection contour minimization, SIGGRAPH 2006) this needs no guess of the side.
#pragma once

#include "anatomy/level_map.h"

namespace mvs::core {

// Moves free nodes of the fine positions `x`. Returns the crossings found at first; `left` is the
// number that remain, then `x` is as it was.
struct Untangled {
  size_t found = 0, left = 0;
};
Untangled untangle(const LevelMap &map, const std::vector<Vec3> &coarse_x, const Model &fine,
                   std::vector<Vec3> &x);

}  // namespace mvs::core
