// Copies a step matrix and factorises it in parts.
#include "solve/dynamic/cached_preconditioner.h"

#include "solve/nodes.h"

namespace mvs::core {
CachedPreconditioner::CachedPreconditioner(const Model &model, std::unique_ptr<DirectSolver> factor)
    : model_(&model), factor_(std::move(factor)) {}

bool CachedPreconditioner::is_of(const PreconditionerKey &key, uint32_t done) const {
  const bool same_x = key_.x.buffer() == key.x.buffer() || same_bits(key_.x, key.x);
  return done_ >= done && same_x && key_.tools == key.tools && key_.pressure == key.pressure &&
         key_.dt == key.dt && key_.damping == key.damping;
}

// Zero blocks are left out: the entries that a pattern keeps of earlier contact must not change the
// factor.
void CachedPreconditioner::copy(const StepMatrix &matrix, const PreconditionerKey &key,
                                const std::vector<uint32_t> *order) {
  key_ = key;
  done_ = 0;
  has_order_ = order != nullptr;
  if (has_order_) {
    copy_in_order(matrix, *order);
  } else {
    copy_blocks(matrix);
  }
}

void CachedPreconditioner::copy_in_order(const StepMatrix &matrix,
                                         const std::vector<uint32_t> &order) {
  system_.set_order(*model_, order);
  row_.resize(matrix.size());
  for (uint32_t r = 0; r < matrix.size(); ++r) row_[r] = system_.row_of[matrix.node(r)];
  permutation_.permute(matrix.blocks(), row_, system_.matrix);
}

void CachedPreconditioner::copy_blocks(const StepMatrix &matrix) {
  const BlockMatrix &m = matrix.blocks();
  nodes_.clear();
  pairs_.clear();
  blocks_.clear();
  diagonal_.clear();
  make_room(pairs_, m.value.size());
  make_room(blocks_, m.value.size());
  for (uint32_t c = 0; c < m.size(); ++c) {
    nodes_.push_back(matrix.node(c));
    diagonal_.push_back(m.value[m.start[c]]);
    for (uint32_t k = m.start[c] + 1; k < m.start[c + 1]; ++k) {
      if (m.value[k].isZero(0)) continue;
      pairs_.push_back({matrix.node(m.row[k]), nodes_.back()});
      blocks_.push_back(m.value[k]);
    }
  }
}

// Sets the rows in the order that the assembler finds for the pattern.
void CachedPreconditioner::find_order() {
  system_.set_pattern(*model_, pairs_);
  for (size_t k = 0; k < pairs_.size(); ++k) system_.add(pairs_[k][0], pairs_[k][1], blocks_[k]);
  row_.resize(nodes_.size());
  for (size_t r = 0; r < nodes_.size(); ++r) {
    system_.add_diagonal(nodes_[r], diagonal_[r]);
    row_[r] = system_.row_of[nodes_[r]];
  }
}

void CachedPreconditioner::analyse() {
  if (!has_order_) find_order();
  factor_->analyse(system_.matrix);
}

bool CachedPreconditioner::factorise_part(uint32_t part) {
  if (part < done_) return true;
  done_ = part + 1;
  if (part == 0) {
    analyse();
    return true;
  }
  const bool positive = factor_->factorise_part(system_.matrix, part - 1, parts() - 1);
  if (!positive) key_ = {};
  return positive;
}

bool CachedPreconditioner::factorise() {
  if (done_ == 0) analyse();
  const bool positive = factor_->factorise(system_.matrix);
  done_ = parts();
  if (!positive) key_ = {};
  return positive;
}

void CachedPreconditioner::add_mass(const StepMatrix &matrix, double times) {
  for (uint32_t r = 0; r < matrix.size(); ++r) {
    system_.add_diagonal(matrix.node(r), Mat3::Identity() * (times * matrix.mass(r)));
  }
}

void CachedPreconditioner::solve(const std::vector<Vec3> &r, std::vector<Vec3> &z) {
  permuted_.resize(r.size());
  for (size_t k = 0; k < r.size(); ++k) permuted_[row_[k]] = r[k];
  factor_->solve(permuted_);
  z.resize(r.size());
  for (size_t k = 0; k < r.size(); ++k) z[k] = permuted_[row_[k]];
}

}  // namespace mvs::core
