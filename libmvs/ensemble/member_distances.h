// Distances between the members of an ensemble, and the equilibria among them.
//
// Input: the final shapes of all members of one model. Output: node and surface distances of every
// member from member 0 and of every pair, and the equilibrium of each (find_equilibria). Sums run
// in a fixed order.
#pragma once

#include <vector>

#include "model/model.h"

namespace mvs::core {

struct MemberDistances {
  // one row per member: its distances from member 0 in m, and the number of its equilibrium
  struct Row {
    double node_rms = 0, node_max = 0, surface_rms = 0, surface_max = 0;
    uint32_t equilibrium = none;
  };
  std::vector<Row> rows;
  std::vector<double> pair_rms;        // members x members, m
  std::vector<double> node_deviation;  // m, RMS distance of each node from its mean position
  uint32_t equilibria = 0;
  // m, over the members at rest
  double node_rms = 0, node_max = 0, surface_rms = 0, surface_max = 0;
};

// `at_rest` has 1 for each converged member; shapes with no node farther apart than `tolerance`, in
// m, are one equilibrium.
MemberDistances member_distances(const Model &model,
                                 const std::vector<const std::vector<Vec3> *> &shapes,
                                 const std::vector<uint8_t> &at_rest, double tolerance);

}  // namespace mvs::core
