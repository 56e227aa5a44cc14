// Surfaces cleaned, and their rims.
#pragma once

#include "patient/surface/clean_surface.h"
#include "patient/surface/rims.h"
#include "tests/patient/surfaces.h"

namespace mvs::core::test {

inline LeafletSheet cleaned(const Surface &s, Findings &findings) {
  return clean_surface(s.x, s.triangles, {}, {}, findings);
}

inline LeafletSheet cleaned(const Surface &s) {
  Findings findings;
  return cleaned(s, findings);
}

inline SheetRims rims_of(const Surface &s, const RimLandmarks &landmarks, Findings &findings) {
  LeafletSheet sheet = cleaned(s);
  return find_rims(sheet, landmarks, findings);
}

}  // namespace mvs::core::test
