// Free edge of a flattened piece of leaflet.
#pragma once

#include "surgery/leaflet/flat.h"

namespace mvs::core {

// Connected stretches of the free edge.
using FlatEdges = std::vector<std::vector<Vec2>>;
FlatEdges free_edges_on(const Surgery &s, const Flat &flat);

// A point of the free edge: a stretch and the arc length on it.
struct Along {
  const std::vector<Vec2> *stretch = nullptr;
  double arc = 0;           // m
  double distance = 1e300;  // m, from the query point
};

Along nearest_along(const FlatEdges &stretches, const Vec2 &p);

// Computes the point `by` m farther along; returns false beyond the ends of the stretch.
bool walk(const Along &along, double by, Vec2 &out);

// Rotates by 90 degrees counter-clockwise.
inline Vec2 turned(const Vec2 &v) {
  return {-v.y(), v.x()};
}

}  // namespace mvs::core
