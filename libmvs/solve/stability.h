// Stability of an equilibrium under follower pressure.
//
// The tangent is K = Ks + N: Ks symmetric, N skew and of the free edge alone. In overdamped motion,
// D dx/dt = -K x with D a multiple of the mass, the equilibrium is stable if and only if every
// eigenvalue of -D^-1 K has a negative real part; the rightmost one is the rate at which the valve
// leaves it or returns to it. Ks positive definite is sufficient: v* K v has the real part v* Ks v.
// One Cholesky factorisation of Ks shows that (second-order work: Challamel, Nicot, Lerbet, Darve,
// hal-00647352, 2009). If it fails, the rightmost eigenvalue decides.
#pragma once

#include <memory>
#include <vector>

#include "energy/total_energy.h"
#include "linalg/direct_solver.h"
#include "linalg/extreme_eigenvalue.h"
#include "solve/solver.h"

namespace mvs::core {

struct Stability {
  bool is_stable = true;
  double stiffness = 0;    // N/m, smallest eigenvalue of Ks
  double rate = 0;         // 1/s, rightmost eigenvalue of -D^-1 K: negative where stable
  std::vector<Vec3> mode;  // its eigenvector by node; the longest displacement has length 1
};

// Keeps the symbolic factorisation of the last pattern, and the last shift.
class StabilityCheck {
 public:
  StabilityCheck();
  // See DirectSolver.
  void use_workers(Workers *workers) { factor_->use_workers(workers); }
  // To be called before each factorisation and solution; it may throw.
  void set_poll(std::function<void()> poll) { poll_ = std::move(poll); }

  // Checks the equilibrium x. `system` holds the exact Hessian there. Without `margins`, the
  // eigenvalues and the mode are computed only if they decide: where Ks is indefinite.
  Stability check(const Model &model, const TotalEnergy &total_energy, const std::vector<Vec3> &x,
                  const HessianAssembler &system, bool margins, SolveStats &stats);

 private:
  bool factorise(const BlockMatrix &matrix, const std::vector<double> &added, SolveStats &stats);

  std::function<void()> poll_ = [] {};
  std::unique_ptr<DirectSolver> factor_;
  BlockMatrix matrix_;
  bool is_analysed_ = false;
  double last_shift_ = 0;  // N/m, that the last indefinite matrix needed
};

// The same for a state on its own: evaluates forces and Hessian at its positions. If `leaves`,
// moves the state a little along the mode of an unstable equilibrium.
Stability check_stability(const Model &model, State &state, ContactLaw law, bool leaves,
                          bool margins);
Stability check_stability(const Model &model, const State &state);

}  // namespace mvs::core
