// How far the free edge of a patient's leaflets may be from where it was found.
#pragma once

#include "patient/patient_geometry.h"

namespace mvs::core {

// How far the free edge may be from where it was found; exact without a geometry.
struct EdgeRange {
  double out = 0, in = 0;                     // m
  const PatientGeometry *geometry = nullptr;  // of the valve
};

// From an error of the edge (m, farther out or in) and the tissue that may be missing below it (m;
// 0: half of the mean depth of the notches that were filled, if there are any), with findings.
EdgeRange find_edge_range(double error, double known_lost, const PatientGeometry &g,
                          Findings &findings);

}  // namespace mvs::core
