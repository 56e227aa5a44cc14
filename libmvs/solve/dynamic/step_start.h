// Positions and velocities at the start of an implicit step, with the forces and energies there.
//
// The trial that a step accepts has its sheet forces already, so the next step takes them over if
// pressure, instruments and positions are the same, bit for bit. The springs of hands are added
// anew every step: they are all that changes when only hands move.
#pragma once

#include "energy/total_energy.h"
#include "solve/dynamic/time_step.h"

namespace mvs::core {

// A configuration that the line search tries.
struct StepTrial {
  std::vector<Vec3> x, v;            // m, m/s
  std::vector<Vec3> sheet_gradient;  // N, dE/dx without hands
  double kinetic = 0;                // J
};

struct StepStart {
  std::vector<Vec3> x, v;                      // m, m/s
  std::vector<Vec3> gradient, sheet_gradient;  // N, dE/dx with and without hands
  double energy = 0, sheet_energy = 0;         // J, with and without hands
  double residual = 0;                         // N, the largest force on a free node
  double kinetic = 0;                          // J
  Load load;
  std::vector<Tool> pushing;  // the instruments that push, where `is_evaluated`
  bool is_evaluated = false;  // gradients and energies are those of x, load and pushing

  // Takes positions, velocities, load and tools of a state; evaluates the total energy there if
  // the forces of the step before do not serve. `slack`: m, of the broad phase.
  void begin(const Model &model, TotalEnergy &total_energy, const State &state, double slack,
             SolveStats &stats);
  // Evaluates the total energy at x.
  void evaluate(const Model &model, TotalEnergy &total_energy, double slack, SolveStats &stats);
  // Moves to a trial of which the sheet gradient was the last evaluation of the total energy.
  void accept(const Model &model, TotalEnergy &total_energy, StepTrial &trial);
  // Sets all velocities to zero.
  void stop();
  // Whether nothing drives the valve: neither out-of-balance forces nor, in the same unit, the rest
  // of its motion, m |v| / dt. A valve sleeps as a whole. Parts that sleep beside moving ones would
  // need a tolerance of their own at their rim, for at best the third of the nodes that stand still
  // while a hand moves (tests/bench, bench_step).
  bool is_at_rest(const Model &model, double dt) const;

 private:
  void add_hands(const Model &model, TotalEnergy &total_energy);
};

// Out-of-balance force up to which a valve under a load counts as at rest, N: the default residual
// of mvs_settle at systolic pressure, less in proportion to the pressure.
double rest_tolerance_of(const Load &load);

}  // namespace mvs::core
