// A piece of a valve on its own, for bringing to rest what one operation disturbed.
//
// The nodes near the disturbance are free, the others are held where they are. The piece has every
// triangle that a free node could meet without going farther than the leash: as long as it does
// not, nothing in the piece can pass through what was left out, and the forces on its free nodes
// are those of the whole valve.
#pragma once

#include <vector>

#include "model/model.h"

namespace mvs::core {

struct LocalSubproblem {
  Model model;                 // what the potential needs of it; no names, masses or fibres
  std::vector<uint32_t> node;  // node of the whole valve by node of the piece
};

struct Extent {
  double radius;  // m from the disturbance: nodes up to there are free ...
  size_t most;    // ... but no more than about so many, the nearest
  double leash;   // m that a free node may go
};

// Distances are those of the present shape, so that what touches goes along.
LocalSubproblem cut_out(const Model &whole, const std::vector<Vec3> &x,
                        const std::vector<uint32_t> &places, const Extent &extent);

}  // namespace mvs::core
