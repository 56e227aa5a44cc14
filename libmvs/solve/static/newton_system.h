// The linear system of a Newton iteration: (H + lambda D) dx = -g, D a diagonal stiffness that the
// load itself has (pressure times element size). Near rest the skew part that a follower load has
// at the free edge is solved for as well, by GMRES with the factor as preconditioner.
#pragma once

#include <functional>

#include "energy/total_energy.h"
#include "linalg/direct_solver.h"
#include "linalg/spmv.h"
#include "solve/solver.h"

namespace mvs::core {

// Decides when the pattern of a matrix gets a new elimination order (settings::newton).
class OrderLifetime {
 public:
  // To be called with each new pattern, the first of an order if it is not kept.
  void begin_pattern();
  // Counts a factorisation of the present pattern with so many products of blocks.
  void count(double products, double rows);
  // Whether the next pattern keeps the order.
  bool is_kept() const { return is_kept_; }

 private:
  bool is_kept_ = false;
  uint32_t patterns_ = 0;  // in this order
  double first_ = 0;       // products of the first factorisation in this order; 0: none yet
  double in_excess_ = 0;   // products beyond that, of all factorisations in this order
};

class NewtonSystem {
 public:
  // `x` are the positions of the current iterate; the elimination order of many rows uses them.
  NewtonSystem(const Model &model, TotalEnergy &total_energy, DirectSolver &factor,
               const std::vector<Vec3> &x)
      : model_(&model), total_energy_(&total_energy), factor_(&factor), x_(&x) {
    assembler_.place = x_;
  }
  // To be called before each ordering, factorisation and solution, which take long on a fine mesh;
  // it may throw.
  void set_poll(std::function<void()> poll) { poll_ = std::move(poll); }
  void poll() const { poll_(); }
  // Begins a closure under a pressure of this size, Pa.
  void set_scale(double pressure, double mean_area);

  // Assembles H at x, the point of the last gradient.
  void assemble(Curvature curvature, Profile &profile);
  // The same with the displacements of the prescribed nodes, for carry().
  void assemble(Curvature curvature, const std::vector<Vec3> &boundary, Profile &profile);
  // Factorises with this lambda; false if the matrix is not positive definite, or if single
  // precision does not suffice.
  bool try_factorise(double lambda, SolveStats &stats);
  // The same with the first larger lambda that makes the matrix positive definite, which `lambda`
  // then is.
  void factorise(double &lambda, SolveStats &stats);
  double applied_lambda() const { return applied_lambda_; }
  // The solver of the factor, for another matrix. The next factorisation analyses its pattern anew.
  DirectSolver &lend_factor() {
    is_analysed_ = false;
    return *factor_;
  }

  // The step of all nodes for the gradient g. Where H is exact and `with_lambda` is false the step
  // solves the system without lambda.
  void solve(const std::vector<Vec3> &g, bool with_lambda, std::vector<Vec3> &step,
             SolveStats &stats);
  // Sets the step of the free nodes to -H_ff^-1 H_fb dx_b: they follow the boundary.
  void carry(std::vector<Vec3> &step, SolveStats &stats);

  // H itself, until the next factorisation.
  const HessianAssembler &hessian();
  Curvature curvature() const { return curvature_; }
  // step^T H step, without lambda.
  double quadratic_form(const std::vector<Vec3> &step) const;

  size_t rows() const { return diagonal_.size(); }
  uint32_t node(size_t row) const { return assembler_.node_of[row]; }
  // Adds `times` the mean stiffness of a row along a unit direction, until drop_stiffening().
  void stiffen(size_t row, const Vec3 &direction, double times);
  void drop_stiffening() { stiffening_.clear(); }

 private:
  void analyse(Profile &profile);
  void count_factorisation(SolveStats &stats);
  void add_lambda(double lambda);
  void solve_rows(std::vector<Vec3> &rows, SolveStats &stats);
  void solve_exactly(bool with_lambda, SolveStats &stats);
  double solve_by_gmres(double removed_lambda, SolveStats &stats);

  std::function<void()> poll_ = [] {};
  const Model *model_;
  TotalEnergy *total_energy_;
  DirectSolver *factor_;
  const std::vector<Vec3> *x_;
  HessianAssembler assembler_;
  Curvature curvature_ = Curvature::balanced;
  std::vector<Mat3> diagonal_;          // of H
  std::vector<double> lambda_scale_;    // N/m per node: D
  std::vector<Mat3> stiffening_;        // N/m per row; empty: no row is stiffened
  std::vector<Vec3> rows_;              // right-hand side and solution
  std::vector<Vec3> direction_, skew_;  // by node, of solve_by_gmres()
  BlockSpmv product_;
  double applied_lambda_ = 0;  // in the factor
  OrderLifetime order_;
  bool is_analysed_ = false;  // the present one, by the factor
};

}  // namespace mvs::core
