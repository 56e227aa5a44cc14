// Points that are one vertex, and sheets without unused vertices.
#pragma once

#include <vector>

#include "patient/leaflet_sheet.h"

namespace mvs::core {

// The median length of the sides of all triangles, m; sides without length do not count. 0 if there
// is no other.
double median_edge(const std::vector<Vec3> &x, const std::vector<Tri> &triangles);

// For each point the first point of its cluster: points nearer to each other than `distance`, also
// over other points, are one cluster (sweep along x; the same result for every order of the input
// up to the numbering).
std::vector<uint32_t> weld_map(const std::vector<Vec3> &x, double distance);

// Keeps the triangles with a mark, in their order.
void keep_triangles(LeafletSheet &sheet, const std::vector<uint8_t> &marks);

// Drops vertices without triangles; the others keep their order.
void drop_unused(LeafletSheet &sheet);

}  // namespace mvs::core
