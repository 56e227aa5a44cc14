// Adds two leaflets and six scallops to a valve.
#include "anatomy/leaflet_names.h"

#include "model/law.h"

namespace mvs::core {

void name_leaflets(LeafletLawId law, double thickness, Valve &valve) {
  for (const char *name : {"A", "P"}) {
    Leaflet leaflet;
    leaflet.name = name;
    leaflet.law = law;
    leaflet.constants = default_constants(find_leaflet_law(law)->constants);
    leaflet.thickness = thickness;
    valve.leaflets.push_back(leaflet);
  }
  for (const char *name : {"A1", "A2", "A3", "P1", "P2", "P3"}) {
    valve.scallops.push_back({0, name, name[0] == 'A' ? 0u : 1u});
  }
}

}  // namespace mvs::core
