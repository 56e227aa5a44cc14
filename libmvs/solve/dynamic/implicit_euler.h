// One linearised backward Euler step: (M / dt^2 + c M / dt + H) dx = -g + M v / dt with the
// projected H, then the cut against collisions. The mechanical energy may not grow by more than
// what the load and the moving boundary put in: a step that makes some is shortened while that
// leads well downhill, then, or where its cuts have turned it across the slope, before the cut;
// where that will not do, the valve stays where it is and stops.
//
// Bounded work: a step may pass over the terms, or factorise and solve, `budget` times. When the
// matrix is not positive definite and the budget ends, the system is solved by its diagonal alone;
// when energies cannot be tried any more, the step is none. Bounds and energies are never left out.
//
// The bits of a step depend on the state alone, though much is kept from one to the next: which
// factors precondition the system is in the state (step_solver.h); the pattern of the matrix holds
// what has touched of late, and entries that are zero change no bit of a product; forces are kept
// with the positions they are of. Nothing is allocated once the memory is there.
#pragma once

#include "energy/total_energy.h"
#include "solve/dynamic/step_matrix.h"
#include "solve/dynamic/step_solver.h"
#include "solve/dynamic/time_step.h"
#include "solve/solver.h"

namespace mvs::core {

// Out-of-balance force up to which a valve under a pressure counts as at rest, N: the default
// residual of mvs_settle at systole, and as much less as the pressure is.
double rest_force(const Load &load);

class ImplicitEuler {
 public:
  ImplicitEuler(const Model &model, uint32_t backend);
  // What the first step from a state would do for those after it: memory, what is near, forces and
  // the factor. Of the state it may take waypoints that fit no more, as a step does.
  void make_ready(State &state, const StepOptions &how);
  void step(State &state, const StepOptions &how, SolveStats &stats);
  // See Potential.
  void begin_call() { total_energy_.begin_call(); }
  uint32_t skipped() const { return total_energy_.skipped(); }

 private:
  void resume(State &state, const StepOptions &how);
  void look(const PreconditionerKey &place, const StepOptions &how, StepMatrix &matrix);
  void begin(const State &state, const StepOptions &how, SolveStats &stats);
  void evaluate(SolveStats &stats);
  void sum_up();
  bool is_at_rest(const State &state, const StepOptions &how) const;
  void solve(State &state, const StepOptions &how, SolveStats &stats);
  PreconditionerKey here(const State &state, const StepOptions &how) const;
  void limit(SolveStats &stats);
  bool go(const StepOptions &how, SolveStats &stats);
  bool go_less(const StepOptions &how, SolveStats &stats);
  bool is_overstretched(const State &state) const;
  double boundary_alone(SolveStats &stats);
  double goes(double share, double dt, SolveStats &stats);
  void stand();
  void place(double share, double dt);
  void arrive();
  void report(SolveStats &stats) const;

  const Model *model_;
  TotalEnergy total_energy_;
  StepMatrix matrix_;
  StepSolver solver_;
  // positions and velocities at the start, and at the end
  std::vector<Vec3> x_, v_, next_x_, next_v_;
  std::vector<Vec3> g_, step_, boundary_, rows_;
  std::vector<Vec3> sheet_g_, next_g_;   // without what hands do
  std::vector<Vec3> alone_x_, alone_g_;  // of boundary_alone()
  double boundary_made_ = -1;            // J, by it in this step; less than 0: not known
  double slack_;                         // m, for Potential::prepare,
  double list_slack_ = 0;                // and for the lists of this step
  double energy_ = 0, sheet_energy_ = 0, residual_ = 0, kinetic_ = 0;
  Load load_;
  std::vector<Tool> pushing_;  // the instruments that push
  // energy and forces of the sheet are those of x_ under load_ and what pushes
  bool evaluated_ = false;
  bool travels_ = false;  // the boundary
  uint32_t left_ = 0;     // of the budget
};

}  // namespace mvs::core
