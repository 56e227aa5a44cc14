// One iteration of a static closure: Newton's method on the total energy inside a trust region, and
// the increments of the boundary on its way to its target (newton_settling.h has the loop).
//
// The matrix is H + lambda D (newton_system.h). Far from rest H is projected to be positive
// semidefinite, but for contact (Curvature::balanced), and lambda follows the gain ratio, the
// measured over the predicted change of energy (Conn, Gould, Toint, Trust-Region Methods, 2000).
// Near rest H is exact, the ratio is 1 minus the error of the predicted change relative to the
// slope, and a full step on the out-of-balance force is tried first, which converges quadratically
// although the follower load has no potential at the free edge. Where the exact Hessian is
// indefinite such steps would end at whatever equilibrium is near: they are taken only if it is
// stable, and an unstable one is left along its mode (solve/stability.h). Conservative continuous
// collision detection shortens every step node by node, so that no sheet passes another
// (collision/step_limiter.h).
//
// Where only a few nodes are far from rest, as after an operation on a closed valve, a local
// subproblem around them is settled first. Where the tissue is bilinear, another one around the
// nodes with the largest forces is settled after each iteration (local_settles.cpp). Both only
// improve the start of the next iteration.
#pragma once

#include "energy/total_energy.h"
#include "linalg/direct_solver.h"
#include "solve/solver.h"
#include "solve/stability.h"
#include "solve/static/backoff.h"
#include "solve/static/boundary_ramp.h"
#include "solve/static/displacement_limit.h"
#include "solve/static/newton_system.h"
#include "solve/static/unstable_returns.h"

namespace mvs::core {

// When a polish step is tried, and with which lambda.
struct PolishSchedule {
  double best_residual;  // N, the smallest that a polish step reached
  double lambda = 0;
  int wait = 0, pause = 1;  // iterations until the next attempt; after the next failure
  // N, of the last iterate with an indefinite Hessian whose equilibrium was found to be stable.
  double stable_residual = 0;
  uint32_t early_leaves = 0;  // of unstable equilibria before the settle has converged to them
};
// A step of all nodes, m.
struct NewtonStep {
  std::vector<Vec3> newton, limited;  // solution of the linear system; after all limits
  double far_share = 0;               // of the nodes: those whose Newton step is much too long
};

// A node that the step limiter stopped.
struct StoppedNode {
  size_t row;
  Vec3 direction;
  double times;  // its Newton step over the limited one
};

// How the settle of a local subproblem begins; as it is: that of a whole valve.
struct LocalStart {
  double max_displacement = 0;  // m, of a node: it ends there; 0: unlimited
  double lambda = 1;            // of the first factorisation
};

// The settle of a local subproblem (local_subproblem.h).
struct LocalSettle {
  double radius;  // m, of its free nodes around the disturbed ones
  LocalStart start;
  double residual;  // N, at which it ends
  uint32_t max_iterations;
};

// Whether the leaflets are of springs or of the bilinear membrane alone, whose stiffness does not
// grow with strain beyond their kink.
bool has_bilinear_tissue(const Model &model);

class Newton {
 public:
  Newton(const Model &model, DirectSolver &factor);

  void set_poll(const std::function<void()> &poll) {
    system_.set_poll(poll);
    check_.set_poll(poll);
  }
  // Starts at a state; `local`: see LocalStart.
  void begin(const State &state, const LocalStart &local);
  // Settles the neighbourhood of a few disturbed nodes, held by the remaining valve: many
  // iterations there cost less than one of the whole valve.
  void presolve_locally(const Load &load);
  // Whether more nodes are disturbed than a local subproblem may have, also by the mean of the
  // forces around them: noise in the positions is no distance from rest.
  bool has_many_disturbed() const;
  // Settles the neighbourhood of the nodes with the largest forces, if these are few and above the
  // tolerance, N. Moves no node unless the forces of the whole valve fall.
  void eliminate(const Load &load, double tolerance);
  void iterate(PolishSchedule &polish);
  void move_boundary(BoundaryRamp &ramp);
  // Whether the present positions, which are in equilibrium, are a stable one. If not, the valve
  // leaves it, unless it always returns to it. `margins`: see SolveOptions.
  bool is_stable(bool margins);
  // Whether the valve left one unstable equilibrium again and again, and is there: it flutters
  // around it.
  bool always_returns() const { return unstable_.are_endless(); }
  // Writes the positions to `state`, with zero velocities; returns the statistics.
  SolveStats finish(State &state);

  const std::vector<Vec3> &x() const { return at_.x; }
  double residual() const { return at_.residual; }  // N
  double energy() const { return at_.energy; }      // J
  // N, of the pressure on a node of mean area.
  double rest_force() const { return pressure_ * mean_area_; }
  bool reached_limit() const { return limit_.reached(); }
  SolveStats &stats() { return stats_; }
  const SolveStats &stats() const { return stats_; }

 private:
  struct Iterate {
    std::vector<Vec3> x, gradient;    // m; N, dE/dx
    double energy = 0, residual = 0;  // J; N, the largest force on a free node
  };
  void evaluate();
  // N: larger residuals have no exact Hessian in the trust region; no polish steps.
  double exact_below() const;
  double polish_below() const;
  double slack() const;  // m, of the broad phase
  void settle_around(const std::vector<uint32_t> &disturbed, const Load &load,
                     const LocalSettle &how);
  bool newton_polish_step(PolishSchedule &polish);
  Stability check_stability(bool margins);
  void leave(const Stability &unstable);
  bool search_on_force(const std::vector<Vec3> &step, int trials);
  // `has_exact`: the system holds the exact Hessian of the present positions.
  void trust_region_step(bool has_exact);
  double try_step(const std::vector<Vec3> &step, std::vector<Vec3> &trial,
                  double &predicted_reduction);
  double gain_ratio(const std::vector<Vec3> &step, double reduction,
                    double predicted_reduction) const;
  void adapt_lambda(double gain, double far_share);
  std::vector<StoppedNode> stopped_nodes(const NewtonStep &step) const;
  bool stiffen(const std::vector<StoppedNode> &stopped);
  void limit_step(NewtonStep &step);
  double free_norm() const;

  const Model *model_;
  TotalEnergy total_energy_;
  Iterate at_;
  NewtonSystem system_;
  StabilityCheck check_;
  SolveStats stats_;
  double pressure_ = 0, mean_area_ = 0;  // Pa, of the load; m^2, of a node
  Curvature far_;                        // of the Hessian far from rest
  double lambda_ = 1;                    // that the next factorisation asks for
  DisplacementLimit limit_;
  UnstableReturns unstable_;
  Backoff elimination_;
};

}  // namespace mvs::core
