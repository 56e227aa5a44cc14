// A piece of a leaflet laid flat: where widths and straight lines mean what they mean to a surgeon.
#pragma once

#include <cmath>

#include "surgery/leaflet/site.h"

namespace mvs::core {

using Vec2 = Eigen::Vector2d;

struct Flat {
  std::vector<Vec2> at;  // m, per node; not a number off the piece
  uint32_t leaflet = none;

  bool has(uint32_t node) const { return std::isfinite(at[node].x()); }
  bool has(const Valve &valve, uint32_t triangle) const;
  Vec2 point(const Valve &valve, const SheetPoint &p) const;
};

// The part of the leaflet of a triangle that lies around that triangle, its rest shape laid flat
// with as little change of lengths as can be, seen from the atrium.
Flat flatten(const Model &model, uint32_t triangle);

// How far a point is from the segment from a to b.
double distance_to_segment(const Vec2 &p, const Vec2 &a, const Vec2 &b);

}  // namespace mvs::core
