// Free edge of a flattened piece by arc length.
#include "surgery/leaflet/flat_edge.h"

#include <algorithm>

namespace mvs::core {

FlatEdges free_edges_on(const Surgery &s, const Flat &flat) {
  FlatEdges stretches;
  for (const std::vector<uint32_t> &loop : s.before.topology.free_edges) {
    // starts off the piece if possible, so that no stretch is divided
    const auto off =
        std::find_if(loop.begin(), loop.end(), [&](uint32_t n) { return !flat.has(n); });
    const size_t begin = static_cast<size_t>(off - loop.begin());
    stretches.emplace_back();
    for (size_t k = 0; k <= loop.size(); ++k) {
      const uint32_t n = loop[(begin + k) % loop.size()];
      if (flat.has(n)) {
        stretches.back().push_back(flat.at[n]);
      } else if (!stretches.back().empty()) {
        stretches.emplace_back();
      }
    }
  }
  return stretches;
}

Along nearest_along(const FlatEdges &stretches, const Vec2 &p) {
  Along best;
  for (const std::vector<Vec2> &stretch : stretches) {
    double arc = 0;
    for (size_t k = 0; k + 1 < stretch.size(); ++k) {
      const Vec2 side = stretch[k + 1] - stretch[k];
      const double away = distance_to_segment(p, stretch[k], stretch[k + 1]);
      if (away < best.distance) {
        const double share = (p - stretch[k]).dot(side) / side.squaredNorm();
        best = {&stretch, arc + std::clamp(share, 0.0, 1.0) * side.norm(), away};
      }
      arc += side.norm();
    }
  }
  return best;
}

bool walk(const Along &along, double by, Vec2 &out) {
  double arc = along.arc + by;
  if (arc < 0) return false;
  for (size_t k = 0; k + 1 < along.stretch->size(); ++k) {
    const Vec2 &a = (*along.stretch)[k], side = (*along.stretch)[k + 1] - a;
    if (arc <= side.norm()) {
      out = a + arc / side.norm() * side;
      return true;
    }
    arc -= side.norm();
  }
  return false;
}

}  // namespace mvs::core
