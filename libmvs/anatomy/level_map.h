// Map between two mesh levels of one valve, and transfer of states between them.
#pragma once

#include <vector>

#include "model/model.h"

namespace mvs::core {

// Place of a fine node on the coarse level: corners of a coarse triangle with weights that sum to
// 1, and the height along its normal, both from the rest shapes. Beyond the boundary of the coarse
// sheet a weight is negative.
struct LevelPlace {
  Tri nodes;
  std::array<double, 3> weight;
  double height;  // m
};

// Every coarse node is a fine node with the same rest position, bit for bit.
struct LevelMap {
  std::vector<uint32_t> fine_of_coarse;  // node of the fine level, for each coarse node
  std::vector<LevelPlace> place;         // for each node of the fine level
};

// Returns for each node of `coarse` the node of `fine` with the same rest position, or `none`.
std::vector<uint32_t> nodes_in(const Valve &coarse, const Valve &fine);

// Computes the place of every fine node: the nearest coarse triangle that a walk over the coarse
// sheet reaches from the nearest common node. The walk does not confuse leaflets that touch. Throws
// MVS_E_ARGUMENT unless all coarse nodes are fine nodes.
LevelMap make_level_map(const Model &coarse, const Model &fine);
LevelMap make_level_map(const Model &coarse, const Model &fine,
                        std::vector<uint32_t> fine_of_coarse);

// Returns the distance of a point from the triangle of a place.
double distance_from(const Model &coarse, const LevelPlace &place, const Vec3 &p);

// Returns the fine state that interpolates a coarse one. Rest shape and rigid motions are
// reproduced to rounding. Where the coarse annulus is at its prescribed position, so is the fine
// one.
State to_fine(const LevelMap &map, const Model &coarse, const Model &fine, const State &state);

// Returns the coarse state: positions and velocities of the common nodes.
State to_coarse(const LevelMap &map, const State &state);

// Transfers a state from one level to another, in either direction. Throws MVS_E_ARGUMENT if the
// models are not two levels of one valve.
State transferred(const Model &from, const State &state, const Model &to);

}  // namespace mvs::core
