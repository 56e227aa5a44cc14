// A finer level of any valve: every triangle is divided into four.
#pragma once

#include "model/model.h"

namespace mvs::core {

// Uniform 1:4 subdivision of the sheet. Old nodes keep their index, new ones (origin `none`) follow
// in the order of the edges. Leaflet, scallop, thickness and fibre are those of the parent
// triangle; the midpoint of an annulus side is prescribed halfway between its ends, open and
// loaded; chordae, heads, ids and names stay. The rest shape stays the same polyhedral surface,
// without smoothing, so that closures of two levels differ only by the discretisation of the
// solution.
Valve refine(const Model &model);

}  // namespace mvs::core
