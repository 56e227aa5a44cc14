// Flattened piece of a leaflet, on which widths and straight lines are defined.
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

// Flattens the rest shape of the leaflet around a triangle with minimal distortion, seen from the
// atrium.
Flat flatten(const Model &model, uint32_t triangle);

// Distance of a point from the segment a b.
double distance_to_segment(const Vec2 &p, const Vec2 &a, const Vec2 &b);

}  // namespace mvs::core
