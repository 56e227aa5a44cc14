// Linear search: a few thousand distances.
#include "session/nearest.h"

#include <cmath>
#include <limits>

#include "geometry/distance.h"

namespace mvs::core {

NearChord nearest_chord(const ModelState &now, const Vec3 &place) {
  NearChord found = {0, std::numeric_limits<double>::infinity()};
  const std::vector<Vec3> &x = now.state.x;
  for (const Chord &c : now.model->valve.chords.get()) {
    const double distance = std::sqrt(closest_on_segment(place, x[c.a], x[c.b]).distance2);
    if (distance < found.distance) found = {c.id, distance};
  }
  return found;
}

NearNode nearest_node(const ModelState &now, const Vec3 &place) {
  NearNode found = {none, std::numeric_limits<double>::infinity()};
  const std::vector<Vec3> &x = now.state.x;
  for (uint32_t i = 0; i < x.size(); ++i) {
    if (now.model->topology.node_kind[i] != NodeKind::leaflet) continue;
    const double distance = (x[i] - place).norm();
    if (distance < found.distance) found = {i, distance};
  }
  return found;
}

}  // namespace mvs::core
