// A finer level of any valve: every triangle becomes four.
#pragma once

#include "model/model.h"

namespace mvs::core {

// Cuts every side of the sheet in half. Old nodes keep their index, new ones (origin `none`) follow
// in the order of the edges. Leaflets, scallops, thickness and fibres are the parent triangle's;
// the middle of an annulus side is held halfway between its ends, open and loaded; chordae, heads,
// ids and names stay. The rest shape stays the same surface of flat triangles, without smoothing,
// so that closures of two levels differ by what the mesh does to the solution and by nothing else.
Valve refine(const Model &model);

}  // namespace mvs::core
