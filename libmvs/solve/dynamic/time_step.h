// What the steppers in time share: how the boundary travels, and energy in motion.
#pragma once

#include <vector>

#include "model/model.h"

namespace mvs::core {

// How to take one step in time, all filled in.
struct StepOptions {
  double dt, damping;  // s, 1/s
  uint32_t budget;     // of an implicit step: see ImplicitStepper
  bool may_sleep;      // whether an implicit step of a valve at rest may do nothing
};

// The largest speed at which annulus and heads travel to their targets, m/s.
inline constexpr double boundary_speed = 0.1;

// Where the prescribed nodes are after a time dt on their way to the state's targets. Says whether
// any of them moves.
bool advance_boundary(const Model &model, const State &state, double dt, std::vector<Vec3> &step);

double kinetic_energy(const Model &model, const std::vector<Vec3> &v);

}  // namespace mvs::core
