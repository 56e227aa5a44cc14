// The exact tangent K = Ks + N of an equilibrium and solutions with it or its transpose, by a
// sparse Cholesky factor of the symmetric part Ks inside iterative refinement. For few solutions
// the factor preconditions GMRES (Saad, Iterative Methods for Sparse Linear Systems, 2003). For
// many the skew part N of the follower pressure, which couples the nodes of the free edge alone, is
// eliminated by the Woodbury identity with a dense factor over these nodes (Hager, SIAM Review 31,
// 1989).
//
// Unlike the Hessians of a settle it is never projected. Vectors have one entry a node; entries of
// prescribed nodes are zero in solutions.
#pragma once

#include <memory>
#include <vector>

#include "energy/total_energy.h"
#include "linalg/cholesky.h"
#include "linalg/spmv.h"
#include "sensitivity/dense_factor.h"

namespace mvs::core {

using NodeField = std::vector<Vec3>;  // one vector a node

class EquilibriumTangent {
 public:
  // `state` has a position for each node of `model`, points of instruments included.
  EquilibriumTangent(const Model &model, const State &state);

  // Makes the dense factor, if that pays for this number of solutions with K (not its transpose).
  void expect_solutions(size_t count);
  // Solves K y = b, or its transpose, in place of b; prescribed entries of b are ignored.
  void solve(NodeField &b, bool transposed);
  // y = K v or its transpose, over all nodes: also for motion of prescribed nodes.
  void multiply(const NodeField &v, bool transposed, NodeField &y);
  // The gradient of the energy at x, near the equilibrium, with the forces of follower pressure.
  const NodeField &gradient_at(const NodeField &x);

  // The smallest eigenvalue of Ks over the leaflets, with branch points in equilibrium, to 10 %,
  // N/m.
  double smallest_stiffness();
  bool is_definite() const { return shift_ == 0; }

  double residual() const { return residual_; }          // N, at the equilibrium
  double linear_error() const { return linear_error_; }  // largest |K y - b| / |b| so far
  const NodeField &gradient() const { return gradient_; }
  // Prepared for the equilibrium.
  TotalEnergy &energy() { return total_energy_; }

 private:
  void factorise();
  void find_edge();
  void fix_loose_rows();
  void apply(const NodeField &rows, bool transposed, NodeField &y);
  void approximate(bool transposed, double tolerance, NodeField &r);
  void eliminate_skew(NodeField &r);
  void iterate_on_edge(bool transposed, double tolerance, NodeField &r);
  double refine(const NodeField &b, bool transposed, double tolerance, NodeField &x);

  const Model *model_;
  const State *state_;
  TotalEnergy total_energy_;
  Profile profile_;
  HessianAssembler free_, all_;  // rows of the free nodes; rows of all nodes, made when needed
  std::unique_ptr<RowSolver> factor_;
  BlockSpmv product_;
  NodeField gradient_, trial_;              // at the equilibrium; of gradient_at()
  NodeField direction_, skew_, residuals_;  // work space
  std::vector<uint8_t> is_loose_;           // rows without stiffness
  std::vector<uint32_t> edge_;              // rows that N couples
  std::unique_ptr<DenseFactor> dense_;
  double shift_ = 0;  // N/m on the diagonal of the factor, where Ks is indefinite
  double residual_ = 0, linear_error_ = 0;
};

}  // namespace mvs::core
