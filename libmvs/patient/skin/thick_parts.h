// Parts of the sides of a skin behind which the tissue is far thicker than elsewhere, as that of
// myxomatous leaflets and of a calcified annulus.
#pragma once

#include "patient/skin/skin_sides.h"

namespace mvs::core {

// The triangles of a skin with their neighbours and the tissue behind them.
struct SkinTriangles {
  const LeafletSheet &skin;
  const std::vector<TissueBehind> &behind;
  const std::vector<uint32_t> &across;  // join_sides()
  const std::vector<Vec3> &normal;      // unit, out of the tissue
};

// Adds to the sides, by region growing, the triangles behind which parallel tissue lies more than
// `least` (m) away, and the flanks that lead from a side to them. Walls of rims face each other
// across a whole leaflet, too: they stand upright on the sides, and are narrower than the tissue
// between them is thick. Without thick parts `side_of` keeps its values.
void add_thick_parts(const SkinTriangles &triangles, double least, std::vector<uint32_t> &side_of);

}  // namespace mvs::core
