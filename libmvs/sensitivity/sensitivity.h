// Derivatives of quantities of an equilibrium with respect to parameters: adjoint or direct
// differentiation with the exact tangent, a test of both sides, and one-sided derivatives where
// chordae, springs or contact are about to switch.
#pragma once

#include "sensitivity/quantities.h"
#include "solve/solver.h"

namespace mvs::core {

struct SensitivityOptions {
  bool with_motion = false, direct = false, tests = true, with_margin = true;
  double slack = 1e-7;  // m
  Progress progress;    // may be empty
};

struct Sensitivity {
  size_t nodes = 0;                              // rows of `motion` for each parameter
  std::vector<double> value;                     // per quantity
  std::vector<double> derivative, above, below;  // a row a quantity
  std::vector<mvs_sensitivity_notes> quantity_notes, parameter_notes;
  std::vector<uint32_t> weak_chords;
  std::vector<uint32_t> weak_contacts;  // their vertices
  uint32_t kinks = 0;                   // of springs and chordae
  NodeField motion;                     // dx/dp of each parameter in turn
  uint32_t adjoint_solves = 0, direct_solves = 0;
  double residual = 0, linear_error = 0, stiffness_margin = 0;
};

// Throws MVS_E_STATE if the state is not at rest or not stable, MVS_E_ARGUMENT for parameters and
// quantities that the valve does not have, MVS_E_CANCELLED if progress cancels.
Sensitivity differentiate(const Model &model, const State &state,
                          const std::vector<Quantity> &quantities,
                          const std::vector<Parameter> &parameters,
                          const SensitivityOptions &options);

// The state with idle branch points out of the way (idle_branches.h). Throws MVS_E_STATE unless it
// is at rest.
State with_slack_branches(const Model &model, const State &state, double slack);

// Returns the growth rate, 1/s, of the slowest motion, minus infinity where Ks is definite; throws
// MVS_E_STATE for an unstable equilibrium, or one that is not at rest.
double must_be_stable(const Model &model, const State &state, const EquilibriumTangent &tangent);

}  // namespace mvs::core
