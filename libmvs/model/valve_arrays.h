// The arrays of a valve as tables, for code that treats all of them alike: hashing, sharing,
// renumbering, copying rows. A new array of Valve is added here and to valve.h.
#pragma once

#include <algorithm>

#include "model/valve.h"

namespace mvs::core {

// Calls visit(&Valve::member) for each array with one row per triangle, except the corners.
template <typename Visit>
void for_each_triangle_array(Visit visit) {
  visit(&Valve::triangle_leaflet);
  visit(&Valve::triangle_scallop);
  visit(&Valve::triangle_thickness);
  visit(&Valve::triangle_fibre);
}

// Calls visit(&Valve::member) for each array, in the order of their declaration.
template <typename Visit>
void for_each_array(Visit visit) {
  visit(&Valve::rest);
  visit(&Valve::open);
  visit(&Valve::loaded);
  visit(&Valve::origin);
  visit(&Valve::triangles);
  for_each_triangle_array(visit);
  visit(&Valve::annulus);
  visit(&Valve::leaflets);
  visit(&Valve::scallops);
  visit(&Valve::chords);
  visit(&Valve::heads);
  visit(&Valve::rings);
  visit(&Valve::curves);
}

// Calls visit(&Valve::member, kind, needs_name) for each list of parts with ids and names.
template <typename Visit>
void for_each_part_list(Visit visit) {
  visit(&Valve::leaflets, "leaflet", true);
  visit(&Valve::scallops, "scallop", true);
  visit(&Valve::heads, "papillary head", false);
  visit(&Valve::chords, "chord", false);
  visit(&Valve::rings, "ring", true);
  visit(&Valve::curves, "curve", true);
}

// Removes the rows that are marked; the others keep their order.
template <typename T>
void remove_rows(CowVector<T> &rows, const std::vector<uint8_t> &marked) {
  std::vector<T> kept;
  for (size_t k = 0; k < marked.size(); ++k) {
    if (!marked[k]) kept.push_back(rows.get()[k]);
  }
  rows = std::move(kept);
}

// Removes the marked triangles with all their per-triangle data.
inline void remove_triangles(Valve &valve, const std::vector<uint8_t> &marked) {
  remove_rows(valve.triangles, marked);
  for_each_triangle_array([&](auto array) { remove_rows(valve.*array, marked); });
}

// Removes the marked nodes and renumbers triangles, annulus, chords and heads, none of which may
// use a marked node. Returns the new number of each node; `none` for the removed ones.
inline std::vector<uint32_t> remove_nodes(Valve &valve, const std::vector<uint8_t> &marked) {
  std::vector<uint32_t> number(marked.size(), none);
  uint32_t next = 0;
  for (size_t n = 0; n < marked.size(); ++n) {
    if (!marked[n]) number[n] = next++;
  }
  for (CowVector<Vec3> *rows : {&valve.rest, &valve.open, &valve.loaded})
    remove_rows(*rows, marked);
  remove_rows(valve.origin, marked);
  for (Tri &triangle : valve.triangles) {
    for (uint32_t &node : triangle) node = number[node];
  }
  for (uint32_t &node : valve.annulus) node = number[node];
  for (Head &head : valve.heads) head.node = number[head.node];
  for (Chord &chord : valve.chords) {
    chord.a = number[chord.a];
    chord.b = number[chord.b];
  }
  return number;
}

}  // namespace mvs::core
