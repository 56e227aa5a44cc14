// Isotropic remeshing of a sheet with two rims to a wanted edge length.
#pragma once

#include "patient/leaflet_sheet.h"

namespace mvs::core {

struct RemeshGoal {
  double edge = 1.5e-3;  // m
  int rounds = 10;       // of splits, collapses, flips and moves
};

struct RemeshReport {
  double worst_angle = 0;           // rad, the least of all triangles
  Vec3 worst_at = Vec3::Zero();     // centroid of that triangle
  Vec3 shortest_at = Vec3::Zero();  // middle of the shortest edge
  double mean_edge = 0;             // m
  double shortest = 0;              // m
  double longest = 0;               // m
  double largest_distance = 0;      // m, between this sheet's and the input: of this one's corners,
                                    // middles of edges and centroids, and of the input's vertices
  size_t crossings = 0;             // pairs of triangles that cross; 0 if the input has none
};

struct RemeshedSheet {
  LeafletSheet sheet;
  SheetRims rims;
  RemeshReport report;
};

// Splits long edges, collapses short ones, flips towards equal valences and moves vertices to the
// middle of their neighbours, in rounds (Botsch & Kobbelt 2004), then improves the worst angles
// and collapses tiny edges. Vertices lie on the input: the annulus' on its polyline, the free
// edge's on its own. No change is made that lets triangles cross or turn over, or that joins rims.
// The same input gives the same bits. A rigid motion or another numbering of the input changes the
// order of edges of equal length, and with it single triangles: the number of vertices by less than
// 3 %, the area by less than 0.1 % on parametric sheets (tests/patient/remesh.cpp). Throws if the
// input is not one sheet, wound alike, with these two rims as its whole boundary.
RemeshedSheet remesh_sheet(const LeafletSheet &sheet, const SheetRims &rims,
                           const RemeshGoal &goal);

}  // namespace mvs::core
