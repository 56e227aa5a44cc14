// The free edge of a piece of leaflet that was laid flat.
#pragma once

#include "surgery/leaflet/flat.h"

namespace mvs::core {

// Stretches of neighbours on the free edge.
using FlatEdges = std::vector<std::vector<Vec2>>;
FlatEdges free_edges_on(const Surgery &s, const Flat &flat);

double distance_to(const FlatEdges &stretches, const Vec2 &p);

// A place on the free edge: a stretch, and how far along it.
struct Along {
  const std::vector<Vec2> *stretch = nullptr;
  double arc = 0;
};

Along nearest_along(const FlatEdges &stretches, const Vec2 &p);

// The point that many m farther along; false beyond the ends of the stretch.
bool walk(const Along &along, double by, Vec2 &out);

// A quarter turn.
inline Vec2 turned(const Vec2 &v) {
  return {-v.y(), v.x()};
}

}  // namespace mvs::core
