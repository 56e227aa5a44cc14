// The class of the library's own Cholesky factorisation: cholesky.cpp has the factorisation by one
// thread, cholesky_solve.cpp the solution, shared_cholesky.cpp the work of several threads.
#pragma once

#include <vector>

#include "base/denormals.h"
#include "linalg/cholesky.h"
#include "linalg/panel/compact_panel.h"
#include "linalg/panel/panel.h"
#include "linalg/subtrees.h"
#include "linalg/symbolic.h"

namespace mvs::core {

// State of the processor during work on panels of T.
template <typename T>
struct Rounding {
  Rounding() {}  // not trivial: no warning of an unused object
};
template <>
struct Rounding<float> : FlushDenormals {};

// Microseconds for a product of blocks in single precision, and for a number of a panel in both
// solutions, about.
inline constexpr double block_product_us = 1.2e-3, panel_number_us = 6e-4;

// Places of rows in the current panel, of one thread.
struct Places {
  std::vector<uint32_t> of_row;  // block row -> its place in the current panel
  std::vector<uint32_t> target;  // rows of a contribution in the current panel
};

// Copies three numbers at a time: most panels have only a few rows.
template <typename T>
void copy_block(const T *from, T *to) {
  for (size_t c = 0; c < 3; ++c) to[c] = from[c];
}

// Panels of double, or of float as a preconditioner; those of float may be solved with in 16 bits
// (compact_panel.h), by one thread.
template <typename T>
class BlockFactor final : public RowSolver {
 public:
  explicit BlockFactor(bool is_compact = false) : is_compact_(is_compact) {}
  void analyse(const BlockMatrix &matrix) override;
  double products() const override { return work_.empty() ? 0 : work_.back(); }
  bool factorise(const BlockMatrix &matrix) override;
  bool factorise_part(const BlockMatrix &matrix, uint32_t part, uint32_t parts) override;
  void solve(std::vector<Vec3> &b) override;
  void choose_rows(const std::vector<uint32_t> &rows) override;
  void solve_rows(std::vector<Vec3> &b) override;

 private:
  using Row = Eigen::Matrix<T, 3, 1>;
  T *panel(const Supernode &s) { return value_.data() + s.panel; }
  // The panel of supernode k in 16 bits.
  CompactPanel compact(size_t k) {
    const Supernode &s = pattern_.node[k];
    return {inverse_.data() + 3 * inverse_numbers * s.first, tiles_.data() + tiles_of_[k],
            scale_.data() + 3 * s.first, 3 * s.width(), s.height()};
  }
  void weigh();
  void compress();
  void solve_compactly();
  size_t begin_of(uint32_t part, uint32_t parts) const;
  bool factorise_supernode(const BlockMatrix &matrix, size_t k, Places &places);
  bool factorise_together(const BlockMatrix &matrix);
  bool factorise_subtrees(const BlockMatrix &matrix);
  void assemble_together(const BlockMatrix &matrix, size_t k);
  bool factorise_panel_together(const Supernode &s);
  void divide();
  void locate(const Supernode &s, Places &places);
  void gather(const BlockMatrix &matrix, const Supernode &s, const Places &places, uint32_t first,
              uint32_t last);
  void subtract(const Contribution &c, const Supernode &to, const Places &by_row, Places &places);
  void load(const Supernode &s, size_t row_end, T *to) const;
  void store_columns(const Supernode &s, const T *from);
  void store_rows(const Supernode &s, size_t row_end, const T *from);
  void solve_forward_at(const Supernode &s, size_t row_end, T *local);
  void solve_backward_at(const Supernode &s, T *local);
  void solve_together();
  void divide_solution();
  void solve_outer_rows(uint32_t begin, uint32_t end);

  Supernodes pattern_;
  std::vector<T> value_;  // all panels
  bool is_compact_;
  std::vector<int32_t> tiles_;    // the same in 16 bits, with a scale for each column
  std::vector<size_t> tiles_of_;  // supernode -> its first word
  std::vector<float> scale_, inverse_;
  std::vector<T> x_;                  // right-hand side, then solution
  std::vector<T> local_;              // right-hand side in the rows of one panel
  std::vector<uint32_t> rows_, way_;  // chosen rows, and the supernodes from them to the root
  std::vector<double> work_;          // products up to the end of each supernode
  std::vector<Places> places_;        // of the calling thread, then of each worker thread
  // for several threads
  Subtrees subtrees_, solved_;  // of a factorisation, of a solution
  bool is_divided_ = false, is_solution_divided_ = false;
  std::vector<std::vector<T>> local_of_thread_;
  std::vector<uint32_t> part_of_row_;  // threads share the rows of the top
};

}  // namespace mvs::core
