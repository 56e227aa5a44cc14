// The closed shape of a patient's leaflets by geometry alone, without a simulation.
//
// Both leaflets reach a coaptation line below the annulus, with a sag, and hang down from there.
// The line joins the commissures; feet of both leaflets with the same place between the commissures
// share a point of it. Its place between the leaflets is where both overlap by the same length; its
// depth gives the overlap that is asked for in the middle, within what normal valves have.
#pragma once

#include "patient/chordae/annulus_frame.h"

namespace mvs::core {

struct ClosedTarget {
  std::vector<Vec3> x;  // of each vertex of the sheet
  double overlap = 0;   // m, of both leaflets at A2-P2 with the stretch of a loaded leaflet
  double depth = 0;     // m, of the line below the plane of the annulus
};

// `boundary`: the annulus under load. Coaptation lengths are 1 to 20 mm.
ClosedTarget closed_target(const PatientGeometry &g, const AnnulusCurve &boundary,
                           double coaptation_length);

}  // namespace mvs::core
