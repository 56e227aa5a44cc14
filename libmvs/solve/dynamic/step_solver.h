// Solves the linear system of an implicit step. A factor made at an earlier place serves as
// preconditioner of conjugate gradients for as long as a few iterations do; the next one is made
// beside, a part a step, so that no step pays for a whole one. Where too much has changed at once,
// a factor is made on the spot.
//
// Which factors there are is in the state (its waypoints), not hidden here: a step goes on alike
// from a state that was saved, undone to, or handed to another solver. What this class keeps only
// saves making them again.
#pragma once

#include <array>
#include <functional>
#include <optional>

#include "linalg/pcg.h"
#include "linalg/spmv.h"
#include "solve/dynamic/cached_preconditioner.h"
#include "solve/dynamic/contact_ordering.h"
#include "solve/solver.h"

namespace mvs::core {

class StepSolver {
 public:
  // Assembles the matrix at a place where the valve was.
  using Look = std::function<void(const PreconditionerKey &, StepMatrix &)>;

  StepSolver(const Model &model, const TotalEnergy &total_energy, uint32_t backend);

  // Sees that the factors of the state's waypoints are there; those that fit neither the valve nor
  // the step are taken out of it.
  void resume(State &state, const StepOptions &how, StepMatrix &matrix, const Look &look);
  // Makes the factor that the next step from here will ask for, if it has none, and has memory for
  // the one to come.
  void make_ready(const StepMatrix &matrix, const PreconditionerKey &here,
                  const std::vector<Vec3> &x, const State &state);
  // Turns right-hand sides into a solution for the matrix, which is that of `here`, at x. May use
  // up what is `left` of the budget but the last `closing` units.
  void solve(StepMatrix &matrix, const PreconditionerKey &here, const std::vector<Vec3> &x,
             State &state, std::vector<Vec3> &rows, uint32_t &left, SolveStats &stats);

  // Of the budget, what is over after the system: a place to try, and the forces where the valve
  // stays.
  static constexpr uint32_t closing = 2;

 private:
  bool remake(const PreconditionerKey &place, uint32_t parts, CachedPreconditioner &factor,
              StepMatrix &matrix, const Look &look);
  void take(const StepMatrix &matrix, const PreconditionerKey &place, CachedPreconditioner &factor,
            Profile &profile);
  void guess(const StepMatrix &matrix, double dt, const std::vector<Vec3> &v);
  bool iterate(const StepMatrix &matrix, std::vector<Vec3> &rows, uint32_t &left,
               SolveStats &stats);
  void work_ahead(const StepMatrix &matrix, const PreconditionerKey &here,
                  const std::vector<Vec3> &x, State &state, uint32_t &left, SolveStats &stats);
  bool factorise_here(const StepMatrix &matrix, const PreconditionerKey &here,
                      const std::vector<Vec3> &x, State &state, std::vector<Vec3> &rows,
                      uint32_t &left, SolveStats &stats);
  bool solve_exactly(const StepMatrix &matrix, const PreconditionerKey &place,
                     std::vector<Vec3> &rows, uint32_t &left, SolveStats &stats);
  void solve_with(CachedPreconditioner &factor, std::vector<Vec3> &rows, SolveStats &stats);
  PreconditionerKey with_place(const PreconditionerKey &here, const std::vector<Vec3> &x);

  const TotalEnergy *total_energy_;
  std::optional<ContactOrdering> order_;  // none: backends find their own
  CachedPreconditioner first_, second_;
  CachedPreconditioner *serving_ = &first_, *coming_ = &second_;
  CachedPreconditioner exact_;
  Pcg pcg_;
  BlockSpmv product_;
  std::vector<Vec3> guess_, solution_;
  uint32_t iterations_ = 0;  // of this step
  // Memory for places: what two states and two factors may hold, and one more.
  std::array<CowVector<Vec3>, 7> places_;
};

}  // namespace mvs::core
