// Two levels of one valve, and how shapes and motions go from one to the other.
#pragma once

#include <vector>

#include "model/model.h"

namespace mvs::core {

// Where a node of the fine level is on the coarse one: corners of a coarse triangle with weights
// that sum to 1, and the height along the triangle's normal. Weights and height are those of the
// rest shapes; beyond the boundary of the coarse sheet a weight is negative.
struct LevelPlace {
  Tri nodes;
  std::array<double, 3> weight;
  double height;  // m
};

// Every node of the coarse level is one of the fine level: it has the same rest place, bit for bit.
struct LevelMap {
  std::vector<uint32_t> fine_of_coarse;  // node of the fine level, for each coarse node
  std::vector<LevelPlace> place;         // for each node of the fine level
};

// The nodes of `fine` at the rest places of the nodes of `coarse`; `none` where there is none.
std::vector<uint32_t> nodes_in(const Valve &coarse, const Valve &fine);

// Finds the place of every fine node: the nearest coarse triangle that a walk over the coarse sheet
// leads to from the nearest node of both levels, so that a leaflet is never mistaken for another
// one that touches it. Throws MVS_E_ARGUMENT unless all coarse nodes are fine nodes.
LevelMap make_level_map(const Model &coarse, const Model &fine);
LevelMap make_level_map(const Model &coarse, const Model &fine,
                        std::vector<uint32_t> fine_of_coarse);

// How far a point lies from the corners and the inside of the triangle of its place.
double distance_from(const Model &coarse, const LevelPlace &place, const Vec3 &p);

// A state of the fine level from one of the coarse level. The rest shape gives the rest shape, a
// rigid motion the rigid motion, both to rounding. Where the coarse annulus is where the heart
// holds it, so is the fine one.
State to_fine(const LevelMap &map, const Model &coarse, const Model &fine, const State &state);

// The state of the coarse level's nodes, as they are.
State to_coarse(const LevelMap &map, const State &state);

// A state for `to` from a state of `from`, whichever of them is the finer one. Throws
// MVS_E_ARGUMENT if they are not two levels of one valve.
State transferred(const Model &from, const State &state, const Model &to);

}  // namespace mvs::core
