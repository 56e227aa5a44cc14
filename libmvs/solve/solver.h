// Solver: brings a valve to rest (static closure) or takes one implicit or explicit step in time.
#pragma once

#include <functional>
#include <memory>

#include "energy/profile.h"
#include "linalg/direct_solver.h"
#include "model/model.h"

namespace mvs::core {

// A zero stands for the default that include/mvs/sim.h states.
struct SolveOptions {
  SolverKind solver = SolverKind::unset;
  uint32_t max_iterations = 0;
  double residual = 0;           // N
  double dt = 0;                 // s
  double damping = 0;            // 1/s
  uint32_t budget = 0;           // of a step
  bool checks_stability = true;  // of the equilibrium that a settle finds
  // The margins of that equilibrium, which cost more than the proof that it is stable and decide
  // nothing once there is one. Without them they stay 0.
  bool margins = true;

  // N, the residual at rest, or its default.
  double tolerance() const;
  // Iterations or steps of a settle, or their default for the solver.
  uint32_t most_iterations() const;
};

struct SolveStats {
  bool converged = false;
  uint32_t iterations = 0;
  uint32_t factorisations = 0;
  uint32_t contact_pairs = 0;
  uint32_t shifted = 0;
  double residual = 0;  // N
  double energy = 0;    // J
  double kinetic = 0;   // J
  double wall_s = 0;
  // of the equilibrium that was checked last; zeros if none was (see Stability)
  bool stable = false;
  double stiffness_margin = 0;  // N/m
  double growth_rate = 0;       // 1/s
  uint32_t untangled = 0;       // crossings removed after interpolation from a coarser mesh
  uint32_t discarded = 0;       // shapes of coarser meshes that were given up
  uint32_t skipped = 0;         // MVS_SKIPPED_*
  uint32_t lowered = 0;         // MVS_LOWERED_*
  Profile work;

  // Adds the counts and times of a run before; keeps the `skipped` bits that both runs have.
  void add(const SolveStats &before) {
    if (before.work.passes > 0) skipped &= before.skipped;
    iterations += before.iterations;
    factorisations += before.factorisations;
    shifted += before.shifted;
    untangled += before.untangled;
    discarded += before.discarded;
    wall_s += before.wall_s;
    work.add(before.work);
  }
};

// Receives the share done and the residual in N; returns true to continue, false to cancel.
using Progress = std::function<bool(double share, double residual)>;

class CoarseLevels;
class Settling;
class Workers;

// Keeps the symbolic factorisation and the broad phase between calls. They change no result: a new
// Solver returns the same bits.
class Solver {
 public:
  // Throws MVS_E_UNSUPPORTED. `workers` outlive the solver; null: the calling thread alone.
  explicit Solver(Backend backend, Workers *workers = nullptr);
  ~Solver();
  Solver(Solver &&) noexcept;
  Solver &operator=(Solver &&) noexcept;

  // Both change `state` in place and leave it undefined when they throw: pass a copy.
  SolveStats settle(const Model &model, State &state, const SolveOptions &options,
                    const Progress &progress);
  SolveStats step(const Model &model, State &state, const SolveOptions &options);
  // Begins the same settle, to be advanced by the caller (settling.h). The solver makes no other
  // call until it has ended, and it and the model outlive it.
  std::unique_ptr<Settling> begin_settle(const Model &model, const State &state,
                                         const SolveOptions &options, const Progress &progress);
  // After steps of another model: does now what the first step of this model would do for those
  // after it, with the options of the last step. Changes no result; reports no error, because that
  // step will.
  void make_ready(const Model &model, const State &state) noexcept;
  // The same for steps of a model that are to begin, also the first ones, with their options.
  // Throws what the step would throw.
  void prepare_step(const Model &model, const State &state, const SolveOptions &options);
  // Coarser meshes of the last models that were settled over a hierarchy.
  CoarseLevels &coarse_levels();

 private:
  std::unique_ptr<Settling> loop_over_nodes(const Model &model, State state,
                                            const SolveOptions &options, const Progress &progress);
  SolveStats step_nodes(const Model &model, State &state, const SolveOptions &options);

  struct Work;
  std::unique_ptr<Work> work_;
};

// Throws MVS_E_FORMAT or MVS_E_VERSION where the solver cache of a state cannot be used with its
// model: for states that come from files.
void check_solver_cache(const ModelState &current);

// Whether the valve is far from rest as a whole: its boundary is not at its target, or more nodes
// than a local subproblem may have are disturbed.
bool far_from_rest(const Model &model, const State &state);

}  // namespace mvs::core
