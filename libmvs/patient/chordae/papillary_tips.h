// Tips of the papillary muscles: given, or assumed from normal anatomy.
#pragma once

#include <optional>

#include "measure/comparison/register.h"
#include "patient/patient_geometry.h"

namespace mvs::core {

struct PapillaryTips {
  std::vector<Vec3> anterolateral, posteromedial;                // at least one each
  std::vector<Vec3> loaded_anterolateral, loaded_posteromedial;  // of each, under load; empty: the
                                                                 // same
};

// Groups given points by their side of the plane between the commissures; without any, assumes one
// tip for each muscle. `loaded`: the same tips under load, in the same order; empty: they follow
// `annulus`, the rigid part of its motion, if it has one. In normal beats the distance of the tips
// from the annulus stays through systole (in classic prolapse it falls by 8.5 +- 2.6 mm: Sanfilippo
// and others, J Am Coll Cardiol 19, 1992), and a closed surface whose frame is shifted as a whole
// does not tether the valve. Throws if tips are too many, too far from the annulus, not below it,
// or all on one side, and if loaded ones are others.
PapillaryTips find_papillary_tips(const std::vector<Vec3> &given, const PatientGeometry &g,
                                  Findings &findings, const std::vector<Vec3> &loaded = {},
                                  const std::optional<Rigid> &annulus = std::nullopt);

}  // namespace mvs::core
