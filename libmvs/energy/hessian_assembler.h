// Hessian assembler: takes 3x3 blocks by node numbers and adds them to a symmetric block matrix.
#pragma once

#include <vector>

#include "base/simd.h"
#include "energy/node_parts.h"
#include "linalg/block_matrix.h"
#include "linalg/outer_product.h"
#include "model/model.h"

namespace mvs::core {

// Free nodes have a row, in elimination order; prescribed nodes have no row. The coupling of a free
// node with a prescribed node that moves by a known displacement is added to the right-hand side.
class HessianAssembler {
 public:
  // Rows from the free nodes of a model; the pattern from pairs of nodes.
  void set_pattern(const Model &model, const std::vector<Edge> &pairs);
  // The same from fixed pairs and additional ones. Keeps the places of the blocks of the fixed
  // pairs.
  void set_pattern(const Model &model, const std::vector<Edge> &always,
                   const std::vector<Edge> &beside);
  // Sets the order of the rows, which every following pattern keeps. The next call has to set a
  // pattern. Patterns keep earlier pairs up to settings::assembly::max_pattern_growth.
  void set_order(const Model &model, const std::vector<uint32_t> &nodes);

  // Whether rows keep their order when the pattern changes.
  void keep_order(bool keep) { keeps_order_ = keep; }

  void clear() {
    matrix.clear();
    boundary_force.assign(matrix.size(), Vec3::Zero());
  }

  // Adds block (i, j), i != j, and its transpose at (j, i). Returns false if the pattern lacks it.
  bool add(uint32_t i, uint32_t j, const Mat3 &block) {
    const uint32_t r = row_of[i], c = row_of[j];
    if (r == none || c == none) {
      if (boundary_step != nullptr) couple(i, j, block);
      return true;
    }
    const uint32_t slot = find(r, c);
    if (slot == none) return false;
    add_at(slot, r > c, block);
    return true;
  }

  // Whether an element of these nodes adds blocks: see HessianPart.
  template <typename Nodes>
  static constexpr bool takes(const Nodes &) {
    return true;
  }

  // The index of the first fixed pair of the term that adds blocks next.
  void begin_term(size_t first) { first_ = first; }
  // The same as add(i, j, block) for nodes i and j that are pair `k` of the term, in any order.
  void add(size_t k, uint32_t i, uint32_t j, const Mat3 &block) {
    if (slots_.empty()) {
      add(i, j, block);
      return;
    }
    const uint32_t slot = slots_[first_ + k];
    if (slot != none) {
      add_at(slot, row_of[i] > row_of[j], block);
    } else if (boundary_step != nullptr) {
      couple(i, j, block);
    }
  }

  // Adds times * slope slope^T, a gradient over four nodes. Their six pairs (1, 0), (2, 0), (2, 1)
  // ... are pairs k to k + 5 of the term.
  void add_outer_product(size_t k, const std::array<uint32_t, 4> &nodes, const Slope &slope,
                         double times);

  MVS_INLINE void add_diagonal(uint32_t i, const Mat3 &block) {
    const uint32_t r = row_of[i];
    if (r != none) matrix.value[matrix.start[r]] += block;
  }

  // Positions of the nodes, nullable: with them nested dissection is tried for many rows.
  const std::vector<Vec3> *place = nullptr;
  BlockMatrix matrix;
  std::vector<uint32_t> row_of;   // node -> row, none where prescribed
  std::vector<uint32_t> node_of;  // row -> node
  // While the boundary moves: the step of every node (zero where free), and -H_fb times it, by
  // rows.
  const std::vector<Vec3> *boundary_step = nullptr;
  std::vector<Vec3> boundary_force;

 private:
  friend class HessianPart;
  uint32_t find(uint32_t r, uint32_t c) const {
    return r > c ? matrix.find(r, c) : matrix.find(c, r);
  }
  MVS_INLINE void add_at(uint32_t slot, bool lower, const Mat3 &block) {
    if (lower) {
      matrix.value[slot] += block;
    } else {
      matrix.value[slot] += block.transpose();
    }
  }
  bool find_outer_product(size_t first, size_t k, const std::array<uint32_t, 4> &nodes,
                          OuterProductTarget &to);
  std::vector<uint32_t> order_of(const std::vector<uint32_t> &nodes,
                                 const std::vector<Edge> &pairs) const;
  void number_rows(const Model &model, const std::vector<Edge> &pairs);
  void take_rows(const std::vector<Edge> &pairs);
  void find_always(const std::vector<Edge> &pairs);
  void place_always();
  void unite(const std::vector<Edge> &other);
  void keep_old_rows();
  void couple(uint32_t i, uint32_t j, const Mat3 &block) {
    if (row_of[i] != none) boundary_force[row_of[i]] -= block * (*boundary_step)[j];
    if (row_of[j] != none) boundary_force[row_of[j]] -= block.transpose() * (*boundary_step)[i];
  }

  bool keeps_order_ = false;
  // pairs of rows, while a pattern is built
  std::vector<Edge> rows_, united_, old_;
  std::vector<Edge> always_;         // the fixed pairs, sorted, as rows
  std::vector<uint32_t> place_;      // of each sorted pair in the matrix
  std::vector<uint32_t> always_of_;  // fixed pair as given -> sorted pair, or none without rows
  std::vector<uint32_t> slots_;      // fixed pair as given -> place in the matrix, or none
  size_t first_ = 0;
};

// The blocks that one thread adds: in the columns of the nodes of its part, from all elements that
// touch such a node, in their order. So each block has the bits of a single thread.
class HessianPart {
 public:
  HessianPart(HessianAssembler &assembler, NodePart part) : assembler_(&assembler), part_(part) {}

  // Sets the blocks and the right-hand side of the part to zero.
  void clear();
  template <typename Nodes>
  bool takes(const Nodes &nodes) const {
    return part_.has_any(nodes);
  }
  // The same as those of the assembler.
  void begin_term(size_t first) { first_ = first; }
  bool add(uint32_t i, uint32_t j, const Mat3 &block);
  void add(size_t k, uint32_t i, uint32_t j, const Mat3 &block);
  void add_outer_product(size_t k, const std::array<uint32_t, 4> &nodes, const Slope &slope,
                         double times);
  void add_diagonal(uint32_t i, const Mat3 &block) {
    if (part_.has(i)) assembler_->add_diagonal(i, block);
  }

 private:
  bool has_column(uint32_t r, uint32_t c) const {
    return part_.has(assembler_->node_of[r < c ? r : c]);
  }
  void couple(uint32_t i, uint32_t j, const Mat3 &block) const;

  HessianAssembler *assembler_;
  NodePart part_;
  size_t first_ = 0;
};

}  // namespace mvs::core
