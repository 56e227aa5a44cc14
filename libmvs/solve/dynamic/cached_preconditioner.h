// Cholesky factor of the matrix of an implicit step, named by its key: made in parts over several
// steps, and kept as a preconditioner for the steps that follow.
#pragma once

#include <memory>

#include "linalg/block_permutation.h"
#include "linalg/direct_solver.h"
#include "solve/dynamic/preconditioner_key.h"
#include "solve/dynamic/step_matrix.h"
#include "solve/step_settings.h"

namespace mvs::core {

class CachedPreconditioner {
 public:
  // Parts of a factorisation, of about equal work: first the pattern, then the numbers.
  static uint32_t parts_for(const Model &model) {
    namespace set = settings::linear;
    return is_large(model) ? set::large_factor_parts : set::factor_parts;
  }
  // Whether factors are dear: points of instruments do not count.
  static bool is_large(const Model &model) {
    return model.valve.triangles.size() >= settings::linear::large_sheet;
  }

  CachedPreconditioner(const Model &model, std::unique_ptr<DirectSolver> factor);

  // Whether at least `done` parts of the factor of this key are made.
  bool is_of(const PreconditionerKey &key, uint32_t done) const;
  uint32_t parts() const { return parts_for(*model_); }
  // Copies the matrix of a key. `order`: elimination order of the nodes, null to find one.
  void copy(const StepMatrix &matrix, const PreconditionerKey &key,
            const std::vector<uint32_t> *order);
  // Makes one part, unless it is made; makes all remaining parts. Returns false and drops the key
  // if the matrix is not positive definite.
  bool factorise_part(uint32_t part);
  bool factorise();
  // Adds `times` the mass that is in the matrix; factorise() has to follow.
  void add_mass(const StepMatrix &matrix, double times);

  // Sets z = A^-1 r, in the rows of a StepMatrix.
  void solve(const std::vector<Vec3> &r, std::vector<Vec3> &z);

 private:
  void copy_in_order(const StepMatrix &matrix, const std::vector<uint32_t> &order);
  void copy_blocks(const StepMatrix &matrix);
  void find_order();
  void analyse();

  const Model *model_;
  std::unique_ptr<DirectSolver> factor_;
  HessianAssembler system_;
  PreconditionerKey key_;
  uint32_t done_ = 0;          // parts
  std::vector<uint32_t> row_;  // of a StepMatrix -> of system_
  BlockPermutation permutation_;
  // a matrix copied without an order: rows by node, blocks below the diagonal by pairs of nodes
  bool has_order_ = false;
  std::vector<uint32_t> nodes_;
  std::vector<Edge> pairs_;
  std::vector<Mat3> blocks_, diagonal_;
  std::vector<Vec3> permuted_;  // a vector in the rows of system_
};

}  // namespace mvs::core
