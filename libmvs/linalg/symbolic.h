// Symbolic Cholesky factorisation on 3x3 blocks with relaxed supernodes: runs of columns with
// nearly the same rows, each stored as one dense panel (Davis, Direct Methods for Sparse Linear
// Systems, 2006, section 4; Ashcraft & Grimes, ACM Trans. Math. Softw. 15, 1989, for the
// relaxation, which trades a few explicit zeros for longer dense runs).
#pragma once

#include <vector>

#include "linalg/block_matrix.h"
#include "linalg/panel/panel.h"

namespace mvs::core {

// A run of columns and the rows below it, ascending; a panel has the columns' own rows before them.
struct Supernode {
  uint32_t first, last;  // block columns first .. last
  size_t row_start;      // its rows below: Supernodes::row[row_start] .. row_end
  size_t row_end;
  size_t panel;  // where its panel starts, in numbers

  uint32_t width() const { return last - first; }
  size_t below() const { return row_end - row_start; }
  // Height of the panel in numbers, rounded up to a multiple of panel_rows.
  size_t height() const {
    return (3 * (width() + below()) + panel_rows - 1) / panel_rows * panel_rows;
  }
};

// Contribution of an earlier supernode to a later one: its rows first .. in_columns are columns of
// the later one, those from there on rows of it.
struct Contribution {
  uint32_t from;
  size_t first, in_columns;  // into Supernodes::row
};

class Supernodes {
 public:
  // Keeps its memory from one pattern to the next.
  void analyse(const BlockMatrix &matrix);

  std::vector<Supernode> node;
  std::vector<uint32_t> row;
  std::vector<size_t> contribution_start;  // of each supernode
  std::vector<Contribution> contribution;  // ascending by `from`
  size_t numbers = 0;                      // in all panels

 private:
  void find_columns(const BlockMatrix &matrix);
  void sort_in(size_t begin, size_t ordered);
  void gather_runs();
  void merge();
  void place_panels();
  void find_contributions();
  bool worth_merging(const Supernode &left, const Supernode &right) const;

  // the factor by single columns
  std::vector<size_t> column_start_;
  std::vector<uint32_t> column_row_, mark_, child_, sibling_, owner_, new_rows_;
};

}  // namespace mvs::core
