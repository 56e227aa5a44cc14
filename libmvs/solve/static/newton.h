// The static closure: Newton on the potential inside a trust region, with the boundary on its way.
//
// The matrix is H + shift * D, D a stiffness the load itself has (pressure times element size). Far
// from rest H is projected (what makes it indefinite is left out) and the shift follows how well
// the quadratic model foretold the energy (Conn, Gould, Toint, Trust-Region Methods, 2000). Near
// rest H is exact and the skew part of the follower load at the free edge is solved for too, so
// that the last iterations converge quadratically although the load has no potential there. Every
// step is cut node by node so that no sheet passes another (physics/step_bounds.h).
//
// Where only a few nodes are far from rest, as after an operation on a closed valve, a piece around
// them is settled first (physics/region.h): a better start, nothing more.
#pragma once

#include "energy/total_energy.h"
#include "linalg/direct_solver.h"
#include "solve/solver.h"

namespace mvs::core {

// Of the stiffness of the load: keeps slack branch points and loose flaps solvable.
inline constexpr double least_shift = 1e-4;

class Newton {
 public:
  Newton(const Model &model, DirectSolver &factor)
      : model_(&model), factor_(&factor), total_energy_(model) {
    total_energy_.keep_near(false);
    system_.place = &x_;
  }

  // Brings state.x to rest under state.load and sets velocities to zero.
  SolveStats settle(State &state, const SolveOptions &options, const Progress &progress);

 private:
  void begin(const State &state);
  void settle_disturbed(const Load &load);
  void evaluate();
  void iterate();
  bool rest_step();
  void travel_step();
  void shorten();
  void note_stopped();
  bool hold();
  double agreement_of(double found, double foretold) const;
  void follow(double agreement);
  double try_step(double &foretold);
  bool may_move_boundary();
  void move_boundary();

  void assemble(Curvature curvature);
  void factorise();
  void solve_system(std::vector<Vec3> &rows);
  void solve(bool with_shift);
  void include_skew(bool with_shift);
  void limit_step();
  bool try_force();
  double free_norm() const;
  double slope() const;
  double curvature_along() const;

  struct Stopped {
    size_t row;
    Vec3 way;      // its direction
    double share;  // the whole way over what is left of it
  };

  const Model *model_;
  DirectSolver *factor_;
  TotalEnergy total_energy_;
  HessianAssembler system_;
  SolveStats stats_;

  std::vector<Vec3> x_, trial_, g_;    // positions, positions tried, dE/dx
  std::vector<Vec3> step_, full_;      // the step as cut, as the system gave it
  std::vector<Vec3> rows_, boundary_;  // right-hand side and solution; step of prescribed nodes
  std::vector<Mat3> diagonal_;         // of the system before a shift
  std::vector<double> shift_scale_;    // N/m per node: D
  std::vector<Stopped> stopped_;
  std::vector<Mat3> hold_;  // N/m per row, of nodes that are stopped; empty: none
  double slack_ = 0;        // m, for Potential::prepare
  double fraction_ = 0;
  double near_force_ = 0, rest_force_ = 0;  // N: below it, exact curvature; attempts at rest
  double shift_ = 0, added_ = 0;            // wanted; in the matrix now
  double rest_shift_ = 0;                   // that the next attempt at rest begins with
  double far_ = 0;                          // share of nodes whose uncut step was much too long
  double energy_ = 0, residual_ = 0;
  double leash_ = 0;        // m, of a piece: no node goes farther from where it was; 0: the whole
  std::vector<Vec3> from_;  // where the nodes of a piece were
  bool held_ = false;       // a node of it would have gone farther
  double best_ = 0;         // N, the smallest residual at rest so far
  Curvature curvature_ = Curvature::projected;
  uint32_t boundary_wait_ = 0;   // iterations that the boundary has waited
  uint32_t patterns_ = 0;        // of the matrix so far
  int wait_ = 0, patience_ = 1;  // iterations until rest_step is tried again
};

}  // namespace mvs::core
