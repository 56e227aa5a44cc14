// Closures of a valve at systolic pressure, from the open shape or from a closed one.
#pragma once

#include <functional>

#include "model/model.h"
#include "solve/solver.h"

namespace mvs::core {

inline constexpr double systolic_pressure = 120 * 133.322;  // Pa

struct ClosedValve {
  ModelPtr model;
  State state;
  SolveStats stats;
};

// From the rest shape, as a caller closes a new valve; it ends after `most_iterations` (0: those of
// a settle), at rest or not.
ClosedValve close_open(Solver &solver, ModelPtr model, double pressure,
                       const Progress &progress = {}, uint32_t most_iterations = 0);

// From a closed valve with the same nodes and other rest lengths; it ends after 150
// iterations, at rest or not.
ClosedValve close_again(Solver &solver, const ClosedValve &from, const Valve &valve);

// Whether a part of a fit ends without MVS_E_DIVERGED, and with `true`.
bool without_divergence(const std::function<bool()> &part);

}  // namespace mvs::core
