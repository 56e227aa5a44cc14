// A surface as people have it, made one connected sheet of triangles that are wound alike.
#pragma once

#include "patient/leaflet_sheet.h"

namespace mvs::core {

// Welds points, drops parts that are no tissue (collapsed, double and flat triangles, unused
// points, pieces below 1 % of the area), opens edges at which more than two triangles meet, gives
// each fan of triangles around a vertex its own vertex, and winds all triangles alike. A surface
// without these faults keeps its points, their numbers and the order of its triangles. `label` (of
// each triangle) and `thickness` (m, of each point) may be empty.
//
// Throws on arrays that do not fit, numbers that are not finite, sizes that no mitral valve has,
// several large pieces, and a surface with one side only (Moebius band).
LeafletSheet clean_surface(const std::vector<Vec3> &points, const std::vector<Tri> &triangles,
                           const std::vector<LeafletLabel> &label,
                           const std::vector<double> &thickness, Findings &findings);

}  // namespace mvs::core
