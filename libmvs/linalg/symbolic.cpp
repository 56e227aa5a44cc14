// Rows of the columns by the elimination tree, then supernodes and their relaxation.
#include "linalg/symbolic.h"

namespace mvs::core {
namespace {

// Returns the largest share of explicit zeros that a merge may add, by the width of the panel in
// blocks: a panel of few columns costs more than the zeros do. After CHOLMOD's relaxation, not
// tuned.
double allowed_zeros(uint32_t width) {
  return width <= 4 ? 0.5 : width <= 12 ? 0.2 : 0.05;
}

size_t blocks_of(const Supernode &s) {
  return s.width() * (s.width() + 1) / 2 + s.width() * s.below();
}

}  // namespace

void Supernodes::analyse(const BlockMatrix &matrix) {
  find_columns(matrix);
  gather_runs();
  merge();
  place_panels();
  find_contributions();
}

// The rows of column j are its own and those of its children in the elimination tree. Those of the
// longest child are sorted already, and most of them.
void Supernodes::find_columns(const BlockMatrix &matrix) {
  const uint32_t n = matrix.size();
  column_start_.assign(n + 1, 0);
  column_row_.clear();
  make_room(new_rows_, n);
  child_.assign(n, none);
  sibling_.assign(n, none);
  mark_.assign(n, none);
  const auto length = [&](uint32_t c) { return column_start_[c + 1] - column_start_[c]; };
  for (uint32_t j = 0; j < n; ++j) {
    const size_t begin = column_row_.size();
    mark_[j] = j;
    const auto take = [&](uint32_t r) {
      if (r <= j || mark_[r] == j) return;
      mark_[r] = j;
      column_row_.push_back(r);
    };
    const auto take_column = [&](uint32_t c) {
      for (size_t k = column_start_[c]; k < column_start_[c + 1]; ++k) take(column_row_[k]);
    };
    uint32_t longest = child_[j];
    for (uint32_t c = child_[j]; c != none; c = sibling_[c]) {
      if (length(c) > length(longest)) longest = c;
    }
    if (longest != none) take_column(longest);
    const size_t ordered = column_row_.size();
    for (uint32_t k = matrix.start[j]; k < matrix.start[j + 1]; ++k) take(matrix.row[k]);
    for (uint32_t c = child_[j]; c != none; c = sibling_[c]) {
      if (c != longest) take_column(c);
    }
    sort_in(begin, ordered);
    column_start_[j + 1] = column_row_.size();
    if (begin == column_row_.size()) continue;
    sibling_[j] = child_[column_row_[begin]];
    child_[column_row_[begin]] = j;
  }
}

// Sorts column_row_ from `begin` on; up to `ordered` it is sorted already.
void Supernodes::sort_in(size_t begin, size_t ordered) {
  if (ordered == column_row_.size()) return;
  new_rows_.assign(column_row_.begin() + static_cast<std::ptrdiff_t>(ordered), column_row_.end());
  std::sort(new_rows_.begin(), new_rows_.end());
  for (size_t to = column_row_.size(), old = ordered, left = new_rows_.size(); left > 0;) {
    const bool takes_old = old > begin && column_row_[old - 1] > new_rows_[left - 1];
    column_row_[--to] = takes_old ? column_row_[--old] : new_rows_[--left];
  }
}

// Gathers successive columns with the same rows.
void Supernodes::gather_runs() {
  const auto n = static_cast<uint32_t>(mark_.size());
  auto rows = [&](uint32_t j) { return column_start_[j + 1] - column_start_[j]; };
  node.clear();
  for (uint32_t j = 0; j < n; ++j) {
    const bool follows =
        j > 0 && rows(j - 1) == rows(j) + 1 && column_row_[column_start_[j - 1]] == j;
    if (!follows) node.push_back({j, j, 0, 0, 0});
    Supernode &s = node.back();
    s.last = j + 1;
    s.row_start = column_start_[j];
    s.row_end = column_start_[j + 1];
  }
}

// Merges a supernode with the one before it, if that is its child and few zeros are added. The
// merged one has the rows of the later one.
void Supernodes::merge() {
  size_t kept = 0;
  for (size_t k = 0; k < node.size(); ++k) {
    Supernode s = node[k];
    while (kept > 0 && worth_merging(node[kept - 1], s)) s.first = node[--kept].first;
    node[kept++] = s;
  }
  node.resize(kept);
}

bool Supernodes::worth_merging(const Supernode &left, const Supernode &right) const {
  if (left.below() == 0 || column_row_[left.row_start] != right.first) return false;
  Supernode both = right;
  both.first = left.first;
  const auto filled = static_cast<double>(blocks_of(left) + blocks_of(right));
  const auto all = static_cast<double>(blocks_of(both));
  return all - filled <= allowed_zeros(both.width()) * all;
}

void Supernodes::place_panels() {
  row.clear();
  make_room(row, column_row_.size());
  numbers = 0;
  for (Supernode &s : node) {
    const size_t begin = row.size();
    for (size_t k = s.row_start; k < s.row_end; ++k) row.push_back(column_row_[k]);
    s.row_start = begin;
    s.row_end = row.size();
    s.panel = numbers;
    // kernels read a little past a panel, where another thread must not write
    numbers += 3 * s.width() * s.height() + panel_slack;
  }
}

// Counts first, then places, so that each supernode's list ascends.
void Supernodes::find_contributions() {
  owner_.resize(mark_.size());
  for (uint32_t s = 0; s < node.size(); ++s) {
    for (uint32_t j = node[s].first; j < node[s].last; ++j) owner_[j] = s;
  }
  auto for_each = [&](auto visit) {
    for (uint32_t s = 0; s < node.size(); ++s) {
      for (size_t k = node[s].row_start; k < node[s].row_end;) {
        const uint32_t to = owner_[row[k]];
        size_t end = k + 1;
        while (end < node[s].row_end && owner_[row[end]] == to) ++end;
        visit(to, Contribution{s, k, end});
        k = end;
      }
    }
  };
  make_room(contribution_start, mark_.size() + 1);
  contribution_start.assign(node.size() + 1, 0);
  for_each([&](uint32_t to, const Contribution &) { ++contribution_start[to + 1]; });
  for (size_t s = 0; s < node.size(); ++s) contribution_start[s + 1] += contribution_start[s];
  make_room(contribution, 2 * contribution_start.back());
  contribution.resize(contribution_start.back());
  for_each([&](uint32_t to, const Contribution &c) { contribution[contribution_start[to]++] = c; });
  for (size_t s = node.size(); s > 0; --s) contribution_start[s] = contribution_start[s - 1];
  if (!contribution_start.empty()) contribution_start[0] = 0;
}

}  // namespace mvs::core
