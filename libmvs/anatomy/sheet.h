// Triangle mesh of half a parametric valve, from the A point over a commissure to the P point.
#pragma once

#include <vector>

#include "anatomy/shape.h"

namespace mvs::core {

// Curves on which a vertex lies, as bits; a vertex slides along one and is fixed where two meet.
enum SheetSide : uint8_t {
  on_annulus = 1,
  on_free_edge = 2,
  on_column = 4,  // the middle of A2, the commissure or the middle of P2
  on_mirror = 8,  // one of the two middles: shared with the other half
};

struct HalfSheet {
  std::vector<Place> place;
  std::vector<Vec3> x;         // open positions
  std::vector<uint8_t> sides;  // SheetSide
  std::vector<Tri> triangles;  // wound so that normals point into the funnel
};

// Returns a near-uniform mesh; the mirrored whole has about `vertices` vertices.
HalfSheet mesh_half_sheet(const Shape &shape, uint32_t vertices);

}  // namespace mvs::core
