// A factor of the matrix of an implicit step at one place: made in parts, kept while the valve goes
// on, and good for the steps around as a preconditioner.
#pragma once

#include <memory>

#include "linalg/block_permutation.h"
#include "linalg/direct_solver.h"
#include "solve/dynamic/preconditioner_key.h"
#include "solve/dynamic/step_matrix.h"

namespace mvs::core {

class CachedPreconditioner {
 public:
  // Parts of about the same work in which a factor is made beside the steps that another serves:
  // first the pattern, then the numbers.
  static constexpr uint32_t parts = 3;

  CachedPreconditioner(const Model &model, std::unique_ptr<DirectSolver> factor);

  // Whether it is of this place, with so many parts of it done at least.
  bool is_of(const PreconditionerKey &place, uint32_t done) const;
  // Copies a matrix, of this place, in an order of elimination; without one it finds its own.
  void take(const StepMatrix &matrix, const PreconditionerKey &place,
            const std::vector<uint32_t> *order);
  // The next part, unless it is done; all that is left. False, and of no place any more, if the
  // matrix is not positive definite.
  bool factorise_part(uint32_t part);
  bool factorise();
  // Adds so many times the mass that is in the matrix, which is to be factorised again.
  void add_mass(const StepMatrix &matrix, double times);

  // z = A^-1 r, by the rows of a StepMatrix.
  void solve(const std::vector<Vec3> &r, std::vector<Vec3> &z);

 private:
  void take_in_order(const StepMatrix &matrix, const std::vector<uint32_t> &order);
  void take_blocks(const StepMatrix &matrix);
  void find_order();
  void analyse();

  const Model *model_;
  std::unique_ptr<DirectSolver> factor_;
  HessianAssembler system_;
  PreconditionerKey place_;
  uint32_t done_ = 0;          // parts
  std::vector<uint32_t> row_;  // of a StepMatrix -> here
  BlockPermutation permutation_;
  // a matrix taken without an order: rows by node, blocks below the diagonal by pairs of nodes
  bool has_order_ = false;
  std::vector<uint32_t> nodes_;
  std::vector<Edge> pairs_;
  std::vector<Mat3> blocks_, diagonal_;
  std::vector<Vec3> turned_;  // a vector in the order here
};

}  // namespace mvs::core
