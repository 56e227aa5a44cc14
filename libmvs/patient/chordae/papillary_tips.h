// Tips of the papillary muscles: given, or assumed from normal anatomy.
#pragma once

#include "patient/patient_geometry.h"

namespace mvs::core {

struct PapillaryTips {
  std::vector<Vec3> anterolateral, posteromedial;                // at least one each
  std::vector<Vec3> loaded_anterolateral, loaded_posteromedial;  // of each, under load; empty: the
                                                                 // same
};

// Groups given points by their side of the plane between the commissures; without any, assumes one
// tip for each muscle. `loaded`: the same tips under load, in the same order; empty: they stay.
// Throws if tips are too many, too far from the annulus, not below it, or all on one side, and if
// loaded ones are others.
PapillaryTips find_papillary_tips(const std::vector<Vec3> &given, const PatientGeometry &g,
                                  Findings &findings, const std::vector<Vec3> &loaded = {});

}  // namespace mvs::core
