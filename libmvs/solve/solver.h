// The solvers over the terms: static closure, implicit step, explicit step.
#pragma once

#include <functional>
#include <memory>

#include "energy/profile.h"
#include "model/model.h"

namespace mvs::core {

// Zeros are the defaults stated in include/mvs/sim.h.
struct SolveOptions {
  uint32_t solver = 0;  // MVS_SOLVER_*
  uint32_t max_iterations = 0;
  double residual = 0;  // N
  double dt = 0;        // s
  double damping = 0;   // 1/s
  uint32_t budget = 0;  // of a step
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
  uint32_t skipped = 0;  // MVS_SKIPPED_*
  uint32_t lowered = 0;  // MVS_LOWERED_*
  Profile work;

  // Counts and times of what was done before; skipped is what was in both.
  void add(const SolveStats &before) {
    if (before.work.passes > 0) skipped &= before.skipped;
    iterations += before.iterations;
    factorisations += before.factorisations;
    shifted += before.shifted;
    wall_s += before.wall_s;
    work.add(before.work);
  }
};

// Told the share done and the residual in N; returns true to go on, false to cancel.
using Progress = std::function<bool(double share, double residual)>;

// Keeps what is worth keeping between calls (symbolic factorisation, candidate pairs), none of
// which changes a result: a new Solver gives the same bits.
class Solver {
 public:
  explicit Solver(uint32_t backend);  // MVS_BACKEND_*; throws MVS_E_UNSUPPORTED
  ~Solver();
  Solver(Solver &&) noexcept;
  Solver &operator=(Solver &&) noexcept;

  // Both change `state` in place and may leave it half-way when they throw: hand in a copy.
  SolveStats settle(const Model &model, State &state, const SolveOptions &options,
                    const Progress &progress);
  SolveStats step(const Model &model, State &state, const SolveOptions &options);
  // Where another model was stepped last: does now what the first step of this one would do for
  // those after it, as for one with the same options. It changes no result, and what goes wrong is
  // for that step to tell.
  void make_ready(const Model &model, const State &state) noexcept;

 private:
  template <typename Solve>
  SolveStats with_points(const Model &model, State &state, const SolveOptions &options,
                         Solve solve);
  SolveStats settle_nodes(const Model &model, State &state, const SolveOptions &options,
                          const Progress &progress);
  SolveStats step_nodes(const Model &model, State &state, const SolveOptions &options);

  struct Work;
  std::unique_ptr<Work> work_;
};

// Throws MVS_E_FORMAT or MVS_E_VERSION where the solver cache of a state cannot be used with its
// model: for states that come from files.
void check_solver_cache(const ModelState &current);

// Whether the valve is far from rest as a whole: its boundary is still to move, or too many nodes
// for a piece around a disturbance feel a force as the load's own.
bool far_from_rest(const Model &model, const State &state);

}  // namespace mvs::core
