// Which sides of closed leaflets face the atrium.
#pragma once

#include <vector>

#include "patient/skin/skin_pieces.h"

namespace mvs::core {

// A skin with the tissue behind its triangles.
struct Skin {
  LeafletSheet sheet;  // normals out of the tissue
  std::vector<TissueBehind> behind;
  std::vector<Vec3> normal;  // unit
  double thickness = 0;      // m, the median
};

enum class SideKind : uint8_t { unknown, atrial, ventricular };

// The kind of each side (parallel_pieces()). Most of an atrial side is seen along `into_atrium`;
// behind it lies a ventricular one, and behind that, within the thickness of one leaflet, an atrial
// one: so the parts are found that touch the other leaflet. Where leaflets are one body,
// ventricular sides lie behind each other. Of the others, which may be all of a leaflet that
// billows, those are atrial that are seen clearly more than what lies behind them.
std::vector<SideKind> side_kinds(const Skin &skin, const std::vector<uint32_t> &side_of,
                                 const Vec3 &into_atrium);

}  // namespace mvs::core
