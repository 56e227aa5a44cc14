// Shortest loops of a surface that do not separate it: around handles, or through them.
#pragma once

#include <vector>

#include "patient/leaflet_sheet.h"

namespace mvs::core {

// A simple loop along edges, in order.
struct SurfaceLoop {
  std::vector<uint32_t> vertices;
  double length = 0;  // m
};

// The number of handles of a connected surface whose boundary loops are filled: the half of the
// rank of its first homology. `across` as join_sides() returns it; `boundaries`: the number of
// boundary loops.
size_t handle_count(const LeafletSheet &surface, size_t boundaries);

// For every vertex near a handle the shortest loops through it of a homology basis: the greedy
// tree-cotree decomposition of Erickson and Whittlesey (2005), with each boundary loop filled. None
// separates the surface, and the shortest loop that does not is among them. Loops longer than
// `longest` are left out. Loops do not touch the boundary.
std::vector<SurfaceLoop> shortest_loops(const LeafletSheet &surface, double longest);

}  // namespace mvs::core
