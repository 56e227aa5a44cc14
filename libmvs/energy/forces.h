// Nodal forces of a state, for output.
#pragma once

#include <vector>

#include "model/model.h"

namespace mvs::core {

struct Forces {
  std::vector<Vec3> total;    // N: out of balance on free nodes, reaction on prescribed ones
  std::vector<Vec3> contact;  // N
  double energy = 0;          // J, total potential
};

// Unlike the solvers, with the tissue between prescribed nodes.
Forces evaluate_forces(const Model &model, const State &state);

}  // namespace mvs::core
