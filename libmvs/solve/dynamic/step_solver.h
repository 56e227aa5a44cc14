// The linear system of an implicit step, by preconditioned conjugate gradients. The preconditioner
// is the Cholesky factor of the matrix of an earlier step, while few iterations are enough; the
// next factor is made beside it, one part a step, so that no step pays for a whole factorisation.
// Where the matrix has changed too much, a factor is made at once.
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
#include "solve/dynamic/dissection_ordering.h"
#include "solve/dynamic/preconditioner_key.h"
#include "solve/dynamic/time_step.h"

namespace mvs::core {

// A step matrix with its right-hand side.
struct StepSystem {
  StepMatrix &matrix;
  PreconditionerKey here;      // of the matrix, without x
  const std::vector<Vec3> &x;  // where it was assembled
  std::vector<Vec3> &rows;     // right-hand side, then solution
};

class StepSolver {
 public:
  // Assembles the matrix of a key.
  using Assemble = std::function<void(const PreconditionerKey &, StepMatrix &)>;

  StepSolver(const Model &model, const TotalEnergy &total_energy, Backend backend);

  // Makes the factors that the solver cache of the state names. Keys that fit neither the valve nor
  // the step are removed from the cache.
  void resume(State &state, const StepOptions &how, StepMatrix &matrix, const Assemble &assemble);
  // Makes the factor that the next step from here needs, unless the cache names one, and allocates
  // memory for the factor after it.
  void make_ready(const StepSystem &system);
  // Solves the system; may use the budget up to the reserved passes. Where the budget ends before,
  // each row is divided by a bound of its sum.
  void solve(const StepSystem &system, State &state, StepWork &work);

 private:
  void make_factors(StepMatrix &matrix, const Assemble &assemble);
  bool remake(const PreconditionerKey &key, uint32_t parts, CachedPreconditioner &factor,
              StepMatrix &matrix, const Assemble &assemble);
  void copy_matrix(const StepMatrix &matrix, const PreconditionerKey &key,
                   CachedPreconditioner &factor, Profile &profile);
  bool is_worn() const;
  bool iterate(const StepSystem &system, StepWork &work);
  void work_ahead(const StepSystem &system, StepWork &work);
  bool factorise_here(const StepSystem &system, StepWork &work);
  bool solve_directly(const StepSystem &system, const PreconditionerKey &key, StepWork &work);
  void solve_with(CachedPreconditioner &factor, std::vector<Vec3> &rows, SolveStats &stats);
  PreconditionerKey key_at(const StepSystem &system);

  const Model *model_;
  const TotalEnergy *total_energy_;
  // of a small sheet; otherwise empty: by dissection, or the backend finds its own
  std::optional<ContactOrdering> order_;
  bool dissects_ = false;
  CachedPreconditioner first_, second_;
  CachedPreconditioner *active_ = &first_, *pending_ = &second_;
  CachedPreconditioner direct_;  // in double precision
  Pcg pcg_;
  BlockSpmv product_;
  std::vector<Vec3> guess_, solution_;
  uint32_t iterations_ = 0;  // of this step
  KeyStore keys_;
  // Memory for the positions of keys: two keys, three factors and one more.
  std::array<CowVector<Vec3>, 6> positions_;
};

}  // namespace mvs::core
