// Where the leaflets of a sheet meet, and which is the anterior one.
#pragma once

#include <optional>

#include "patient/coordinates.h"

namespace mvs::core {

// The anterior leaflet from the posteromedial to the anterolateral commissure: arc lengths along
// the annulus, `to` > `from`; the posterior leaflet is the rest. The annulus runs counter-clockwise
// seen from the atrium (normals into the atrium).
struct LeafletArcs {
  double from = 0, to = 0;
};

// Known landmarks; empty: not known.
struct LeafletLandmarks {
  std::vector<Vec3> commissures;  // two
  std::vector<Vec3> anterior;     // one
  std::vector<Vec3> tips;         // of the papillary muscles: they help to guess the others
};

// From given commissures, else from labels (the arc that agrees best with them), else the arc that
// is most like that of a normal anterior leaflet (leaflet_odds.h). Throws if a landmark is far from
// the sheet or labels lack a leaflet.
LeafletArcs find_leaflets(const LeafletSheet &sheet, const SheetRims &rims,
                          const SheetCoordinates &coordinates, const LeafletLandmarks &landmarks,
                          Findings &findings);

// Scallops A1, A2, A3, P1, P2, P3 in this order: that of a foot.
uint32_t scallop_of(const LeafletArcs &arcs, double foot, double annulus_length);

}  // namespace mvs::core
