// Options and bookkeeping of one step in time, for the implicit and the explicit method.
#pragma once

#include <vector>

#include "model/model.h"
#include "solve/solver.h"

namespace mvs::core {

// Options of one step in time, without defaults left to fill in.
struct StepOptions {
  double dt, damping;  // s, 1/s
  uint32_t budget;     // of an implicit step: see ImplicitEuler
  bool may_sleep;      // an implicit step of a valve at rest may do nothing
  bool margins;        // of a settle: see SolveOptions
};

// One step at work: its options, its statistics, and the passes and factorisations that its budget
// has left.
struct StepWork {
  const StepOptions &how;
  SolveStats &stats;
  uint32_t left;
};

double kinetic_energy(const Model &model, const std::vector<Vec3> &v);

}  // namespace mvs::core
