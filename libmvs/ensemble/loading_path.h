// Loading paths of an ensemble: from a perturbed start to rest under a load, with pressure and
// boundary in different increments and orders.
#pragma once

#include <mvs/ensemble.h>

#include "ensemble/perturbation.h"
#include "solve/solver.h"

namespace mvs::core {

// When the boundary moves: in proportion to the pressure, before it or after it. The numbers are
// those of the C interface.
enum class LoadingOrder : uint32_t {
  together = MVS_ENSEMBLE_ORDER_TOGETHER,
  boundary_first = MVS_ENSEMBLE_ORDER_BOUNDARY_FIRST,
  pressure_first = MVS_ENSEMBLE_ORDER_PRESSURE_FIRST
};

struct Path {
  uint32_t increments = 1;  // equal steps of the pressure
  double ramp = 0;          // s, of the pressure, with inertia; 0: settles after each increment
  LoadingOrder order = LoadingOrder::together;
  Disturbance disturbance;
  Random random{0, 0};
  bool plain = false;  // the plain closure, whose divergence is an error of the whole ensemble
};

// Returns path `number`; number 0 is the plain closure. Fifteen ways of loading repeat, each time
// with another disturbance.
Path make_path(uint32_t number, const Disturbance &disturbance, uint64_t seed);

// The end of a path.
struct Closing {
  State state;
  SolveStats stats;
  double moved = 0;  // m, the largest displacement of a node of the start
  bool diverged = false;
};

// Follows a path from `start` to rest under `load`. Throws where the progress callback cancels.
Closing close_along(Solver &solver, const Model &model, const State &start, const Load &load,
                    const SolveOptions &options, const Path &path, const Progress &progress);

}  // namespace mvs::core
