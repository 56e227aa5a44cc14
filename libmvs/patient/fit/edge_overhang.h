// Tissue that the closed surface shows beyond the free edge of the simulated closed valve.
//
// Labels of leaflets lack stretches of the free edge, others in the open image than in the loaded
// one. Where the closed surface goes on in the plane of the leaflet, past the free edge of a valve
// that is fitted to it, the open surface lacks tissue. Its depth is the area beyond the edge over
// the length of the edge, as a mean over a few millimetres: a spur has little area.
#pragma once

#include <vector>

#include "patient/fit/closure.h"
#include "patient/fit/surface_match.h"
#include "patient/patient_geometry.h"

namespace mvs::core {

inline constexpr double most_overhang = 5e-3;  // m, as of `edge_lost`: more is no error of an edge

// m, up to most_overhang, at the end of the fibre of each vertex of the sheet of `g`; 0 where
// nothing is beyond the edge. The nodes of `closed` begin with the vertices of the sheet.
std::vector<double> edge_overhang(const PatientGeometry &g, const ClosedValve &closed,
                                  const std::vector<SurfaceMatch> &matches);

}  // namespace mvs::core
