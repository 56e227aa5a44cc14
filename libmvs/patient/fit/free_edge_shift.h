// The free edge of a built valve farther out or in, for an edge that is known to some error only.
//
// Vertices near the free edge move along their fibres (the gradient of the share between annulus
// and free edge): by the whole amount at the edge, less in proportion to the way from it, not at
// all beyond a band, so that the tissue in the band is stretched or shortened evenly. The mesh
// keeps its triangles. Chordae that insert there get shorter or longer by as much as their
// insertion comes nearer to their other end or goes away: tissue that is longer hangs lower, and
// its chordae are shorter.
#pragma once

#include "model/valve.h"
#include "patient/patient_geometry.h"

namespace mvs::core {

// The nodes of `valve` begin with the vertices of the sheet of `g`. `by`: m, outwards; where a
// leaflet is low, less. Where triangles would cross, the edge stays.
Valve with_edge_moved(const Valve &valve, const PatientGeometry &g, double by);
// `by`: at the end of the fibre of each vertex.
Valve with_edge_moved(const Valve &valve, const PatientGeometry &g, const std::vector<double> &by);

}  // namespace mvs::core
