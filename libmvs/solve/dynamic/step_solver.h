// Solves the linear system of an implicit step. A factor made at an earlier place serves as
// preconditioner of conjugate gradients for as long as a few iterations do; the next one is made
// beside, a part a step, so that no step pays for a whole one. Where too much has changed at once,
// a factor is made on the spot.
//
// The solver cache of the state names the matrices that were factorised, so a step from a state
// that was saved, restored by undo or handed to another solver returns the same bits. The factors
// that this class keeps only save factorising those matrices again.
#pragma once

#include <array>
#include <functional>
#include <optional>

#include "linalg/pcg.h"
#include "linalg/spmv.h"
#include "solve/dynamic/cached_preconditioner.h"
#include "solve/dynamic/contact_ordering.h"
#include "solve/dynamic/preconditioner_key.h"
#include "solve/solver.h"

namespace mvs::core {

class StepSolver {
 public:
  // Assembles the matrix at a place where the valve was.
  using Look = std::function<void(const PreconditionerKey &, StepMatrix &)>;

  StepSolver(const Model &model, const TotalEnergy &total_energy, uint32_t backend);

  // Makes the factors that the solver cache of the state names. Keys that fit neither the valve nor
  // the step are removed from the cache.
  void resume(State &state, const StepOptions &how, StepMatrix &matrix, const Look &look);
  // Makes the factor that the next step from here will ask for, if it has none, and has memory for
  // the one to come.
  void make_ready(const StepMatrix &matrix, const PreconditionerKey &here,
                  const std::vector<Vec3> &x);
  // Turns right-hand sides into a solution for the matrix, which is that of `here`, at x. May use
  // up what is `left` of the budget but the last `closing` units.
  void solve(StepMatrix &matrix, const PreconditionerKey &here, const std::vector<Vec3> &x,
             State &state, std::vector<Vec3> &rows, uint32_t &left, SolveStats &stats);

  // Of the budget, what is over after the system: a place to try, and the forces where the valve
  // stays.
  static constexpr uint32_t closing = 2;

 private:
  void make_factors(StepMatrix &matrix, const Look &look);
  bool remake(const PreconditionerKey &place, uint32_t parts, CachedPreconditioner &factor,
              StepMatrix &matrix, const Look &look);
  void take(const StepMatrix &matrix, const PreconditionerKey &place, CachedPreconditioner &factor,
            Profile &profile);
  void guess(const StepMatrix &matrix, double dt, const std::vector<Vec3> &v);
  bool iterate(const StepMatrix &matrix, std::vector<Vec3> &rows, uint32_t &left,
               SolveStats &stats);
  void work_ahead(const StepMatrix &matrix, const PreconditionerKey &here,
                  const std::vector<Vec3> &x, uint32_t &left, SolveStats &stats);
  bool factorise_here(const StepMatrix &matrix, const PreconditionerKey &here,
                      const std::vector<Vec3> &x, std::vector<Vec3> &rows, uint32_t &left,
                      SolveStats &stats);
  bool solve_exactly(const StepMatrix &matrix, const PreconditionerKey &place,
                     std::vector<Vec3> &rows, uint32_t &left, SolveStats &stats);
  void solve_with(CachedPreconditioner &factor, std::vector<Vec3> &rows, SolveStats &stats);
  PreconditionerKey with_place(const PreconditionerKey &here, const std::vector<Vec3> &x);
  void load_keys(const State &state);
  void drop_keys() { set_keys({}); }
  void set_keys(PreconditionerKeys keys);
  void store_keys(State &state);

  const Model *model_;
  const TotalEnergy *total_energy_;
  std::optional<ContactOrdering> order_;  // none: backends find their own
  CachedPreconditioner first_, second_;
  CachedPreconditioner *active_ = &first_, *pending_ = &second_;
  CachedPreconditioner exact_;
  Pcg pcg_;
  BlockSpmv product_;
  std::vector<Vec3> guess_, solution_;
  uint32_t iterations_ = 0;  // of this step
  // The keys of the state at work, and the cache that holds them if `is_packed_`.
  PreconditionerKeys keys_;
  SolverCache packed_;
  bool is_packed_ = true;
  // Memory for positions: two keys, three factors and one more; for caches: two states, this solver
  // and one more.
  std::array<CowVector<Vec3>, 6> places_;
  std::array<CowVector<double>, 4> caches_;
};

}  // namespace mvs::core
