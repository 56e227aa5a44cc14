// Dynamic relaxation (Otter, Nucl. Struct. Eng. 1, 1965): the forces of the explicit method, with
// masses and damping that have nothing to do with a valve and bring it to rest soonest. A peer of
// the benchmarks, not a solver of the library: it lets leaflets cross.
#pragma once

#include "model/model.h"
#include "solve/solver.h"

namespace bench {

// Viscous: near the critical damping of the slowest mode, c = 2 sqrt(v K v / v M v) from the forces
// of the last two steps (Underwood 1983). Kinetic: none, but all speed is taken away at each peak
// of the kinetic energy (Barnes, Int. J. Space Struct. 14, 1999).
enum class Damping { viscous, kinetic };

struct RelaxationOptions {
  Damping damping = Damping::viscous;
  double safety = 1.5;  // of the masses
  // Masses are renewed every 2 steps, or every 10 with a larger margin.
  bool renews_often = false;
  double longest = 5e-4;   // m, displacement of a node in a step
  double residual = 1e-4;  // N, at which a valve is at rest
  uint32_t most = 4000;    // steps
};

// Relaxes a valve under its load with the contact of the explicit solver, to the same rest: ten
// steps in a row below the residual, at a stable equilibrium. `state` is where it ended.
mvs::core::SolveStats relax(const mvs::core::Model &model, mvs::core::State &state,
                            const RelaxationOptions &options);

}  // namespace bench
