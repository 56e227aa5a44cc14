// Nearest chord and nearest free leaflet vertex to a point, by linear search.
#pragma once

#include "history/history.h"

namespace mvs::core {

struct NearChord {
  Id id = 0;
  double distance;  // m; infinity if the valve has no chordae
};
NearChord nearest_chord(const ModelState &now, const Vec3 &place);

// A free vertex of a leaflet.
struct NearNode {
  uint32_t node = none;
  double distance;  // m; infinity if there is no such vertex
};
NearNode nearest_node(const ModelState &now, const Vec3 &place);

}  // namespace mvs::core
