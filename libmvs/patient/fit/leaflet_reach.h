// How far leaflets reach from the annulus: those of a given closed surface beside those of the
// valve that was fitted to it.
//
// Where the surface ends nearer to the annulus than the valve's free edge, it lacks tissue: labels
// of images have eaten edges. A leaflet whose chordae are torn or long reaches as far as others.
#pragma once

#include <vector>

#include "model/model.h"
#include "patient/patient_geometry.h"

namespace mvs::core {

// Triangles of leaflets, with common corners where they meet.
struct LeafletTriangles {
  std::vector<Vec3> points;
  std::vector<Tri> triangles;
  std::vector<uint32_t> leaflet;  // of each triangle
};

// For each point of the surface on a rim of it: how much farther the free edge of the same leaflet
// of the valve reaches from the annulus than the point does, m, along edges (Dijkstra 1959), which
// both meshes lengthen alike. NAN for other points and where no path leads to the annulus.
// `x`: the closed valve; points of the surface at most `band` (m) from its annulus reach as far as
// they are from it.
std::vector<double> missing_reach(const LeafletTriangles &surface, double band, const Model &model,
                                  const std::vector<Vec3> &x, const PatientGeometry &g);

}  // namespace mvs::core
