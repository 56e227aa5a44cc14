// What lies nearest to a place in a valve.
#pragma once

#include "history/history.h"

namespace mvs::core {

struct NearChord {
  Id id = 0;
  double distance;  // m; infinity without chordae
};
NearChord nearest_chord(const ModelState &now, const Vec3 &place);

// Of the free vertices of the leaflets.
struct NearNode {
  uint32_t node = none;
  double distance;  // m; infinity without any
};
NearNode nearest_node(const ModelState &now, const Vec3 &place);

}  // namespace mvs::core
