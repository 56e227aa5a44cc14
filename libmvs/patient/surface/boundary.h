// Boundary loops of a sheet.
#pragma once

#include <vector>

#include "patient/leaflet_sheet.h"

namespace mvs::core {

// The boundary loops in the order in which the triangles pass along them, each from its smallest
// vertex, sorted by that. Needs triangles wound alike, and one fan of them around each vertex, as
// clean_surface() makes them.
std::vector<std::vector<uint32_t>> boundary_loops(const LeafletSheet &sheet);

// Sizes of a closed polygon.
struct LoopShape {
  double length = 0;           // m
  Vec3 centre = Vec3::Zero();  // centroid by length
  Vec3 area = Vec3::Zero();    // m2, along the normal around which the loop runs counter-clockwise
  double chord_length = 0;     // m, of 48 equal steps around it
  double turning = 0;          // total change of direction in turns, of 24 equal steps around it
};
LoopShape shape_of(const LeafletSheet &sheet, const std::vector<uint32_t> &loop);

struct RimLoop {
  std::vector<uint32_t> loop;
  LoopShape shape;
};
// All boundary loops with their shapes, the longest first.
std::vector<RimLoop> sorted_rims(const LeafletSheet &sheet);

}  // namespace mvs::core
