// Ways to close a valve: how pressure and boundary arrive, from which start.
#pragma once

#include "ensemble/perturbation.h"
#include "solve/solver.h"

namespace mvs::core {

struct Path {
  uint32_t increments = 1;  // equal steps of the pressure
  double ramp = 0;          // s: the pressure comes in time, with inertia; 0: at rest between steps
  uint32_t order = 0;       // MVS_ENSEMBLE_ORDER_TOGETHER ...
  Disturbance disturbance;
  Random random{0, 0};
  bool plain = false;  // the plain closure: numbers out of range are a failure of the whole
};

// The number-th way; number 0 is the plain closure. Fifteen ways of loading come in turn, each
// time with another disturbance.
Path make_path(uint32_t number, const Disturbance &disturbance, uint64_t seed);

// How a path ended.
struct Closing {
  State state;
  SolveStats stats;
  double moved = 0;  // m, the farthest that a node of the start was moved
  bool diverged = false;
};

// Goes along a path from `start` to rest under `load`. Cancelling throws.
Closing close_along(Solver &solver, const Model &model, const State &start, const Load &load,
                    const SolveOptions &options, const Path &path, const Progress &progress);

}  // namespace mvs::core
