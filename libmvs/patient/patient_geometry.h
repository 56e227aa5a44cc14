// A patient's leaflets with all that was found on them.
#pragma once

#include "patient/coordinates.h"
#include "patient/leaflets.h"

namespace mvs::core {

struct PatientGeometry {
  LeafletSheet sheet;  // at rest
  SheetRims rims;      // the annulus counter-clockwise seen from the atrium
  SheetCoordinates coordinates;
  LeafletArcs arcs;
};

}  // namespace mvs::core
