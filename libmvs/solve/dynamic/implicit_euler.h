// Linearly implicit Euler: one step solves (M / dt^2 + c M / dt + H) dx = -g + M v / dt, H the
// Hessian projected to be positive semidefinite, limits dx by conservative continuous collision
// detection, and searches along it for a configuration whose mechanical energy does not exceed that
// of the start by more than the work of the load and of the moving boundary. If the search fails,
// the valve stays where it is and stops.
//
// Bounded work: a step may evaluate the total energy, or factorise and solve, `budget` times. Where
// the budget ends before the linear system is solved, its diagonal serves; where it ends before a
// trial is accepted, no node moves. Step limits and energies are never left out.
//
// The bits of a step depend on the state alone, though much is kept from one step to the next. The
// solver cache of the state names the matrices whose factors are preconditioners (step_solver.h).
// The pattern of the matrix keeps entries of earlier contact, which are zero and change no bit of a
// product. Forces are kept with the positions they belong to. A warm step allocates nothing.
#pragma once

#include "energy/total_energy.h"
#include "solve/dynamic/energy_line_search.h"
#include "solve/dynamic/step_matrix.h"
#include "solve/dynamic/step_solver.h"
#include "solve/dynamic/step_start.h"
#include "solve/dynamic/time_step.h"
#include "solve/solver.h"

namespace mvs::core {

class ImplicitEuler {
 public:
  static constexpr ContactLaw contact_law = ContactLaw::barrier;
  // `workers` outlive the solver; null: the calling thread alone.
  ImplicitEuler(const Model &model, Backend backend, Workers *workers = nullptr);
  // Does now what the first step from a state would do for those after it: memory, broad phase,
  // forces, factor. Like a step it may remove keys that do not fit from the solver cache.
  void make_ready(State &state, const StepOptions &how);
  void step(State &state, const StepOptions &how, SolveStats &stats);
  // See TotalEnergy.
  void begin_call() { total_energy_.begin_call(); }
  uint32_t skipped() const { return total_energy_.skipped(); }

 private:
  void resume(State &state, const StepOptions &how);
  void begin(const State &state, StepWork &work);
  bool is_at_rest(const StepOptions &how) const;
  void sleep(State &state, SolveStats &stats);
  void solve_linear_system(State &state, StepWork &work);
  double limit_step(SolveStats &stats);
  PreconditionerKey key_here(const State &state, const StepOptions &how) const;
  void report(SolveStats &stats) const;

  const Model *model_;
  TotalEnergy total_energy_;
  StepMatrix matrix_;
  StepSolver solver_;
  EnergyLineSearch line_search_;
  StepStart start_;
  BoundaryStep boundary_;
  std::vector<Vec3> rows_;          // right-hand side and solution of the linear system
  std::vector<Vec3> displacement_;  // m, by node
  double slack_;                    // m, of the broad phase of a slow step
};

}  // namespace mvs::core
