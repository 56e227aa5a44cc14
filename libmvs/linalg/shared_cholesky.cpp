// Factorisation and solution by several threads: disjoint subtrees of the elimination tree, then
// the columns and rows of each panel above them. A panel has the same bits whoever computes it and
// in which parts, and each number of a solution takes its products in the order of a single thread.
#include <algorithm>
#include <atomic>
#include <numeric>

#include "linalg/block_factor.h"

namespace mvs::core {
namespace {

// Largest share of the work in a subtree that one thread factorises, and solves. A solution is so
// short that only few supernodes may wait for each other.
constexpr double factor_share = 1.0 / 24, solve_share = 1.0 / 6;

}  // namespace

template <typename T>
void BlockFactor<T>::divide() {
  if (!is_divided_) {
    std::vector<double> work(work_.size());
    std::adjacent_difference(work_.begin(), work_.end(), work.begin());
    subtrees_.divide(pattern_, work, factor_share);
    is_divided_ = true;
  }
  places_.resize(1 + workers()->width());
  for (Places &places : places_) {
    places.of_row.resize(x_.size() / 3);
    places.target.resize(x_.size() / 3);
  }
}

template <typename T>
bool BlockFactor<T>::factorise_together(const BlockMatrix &matrix) {
  const Rounding<T> rounding;
  divide();
  if (!factorise_subtrees(matrix)) return false;
  for (const uint32_t k : subtrees_.top()) {
    const Supernode &s = pattern_.node[k];
    const double products = work_[k] - (k > 0 ? work_[k - 1] : 0);
    if (!pay_for(workers(), products * block_product_us)) {
      if (!factorise_supernode(matrix, k, places_[0])) return false;
      continue;
    }
    assemble_together(matrix, k);
    if (!factorise_panel_together(s)) return false;
  }
  return true;
}

// Each thread takes the next group of subtrees. After a failure the numbers do not matter.
template <typename T>
bool BlockFactor<T>::factorise_subtrees(const BlockMatrix &matrix) {
  std::atomic<uint32_t> next{0};
  std::atomic<bool> is_positive{true};
  workers()->parallel_for(workers()->width(), [&](uint32_t thread) {
    for (uint32_t group; (group = next++) < subtrees_.count();) {
      for (const uint32_t *k = subtrees_.begin(group); k != subtrees_.end(group); ++k) {
        if (!is_positive) return;
        if (!factorise_supernode(matrix, *k, places_[1 + thread])) is_positive = false;
      }
    }
  });
  return is_positive;
}

// Columns of the matrix and contributions of earlier panels, some columns at a time.
template <typename T>
void BlockFactor<T>::assemble_together(const BlockMatrix &matrix, size_t k) {
  const Supernode &s = pattern_.node[k];
  locate(s, places_[0]);
  // an even number of blocks fills the tiles of a kernel
  const uint32_t pairs = (s.width() + 1) / 2;
  const uint32_t parts = std::min(pairs, 4 * workers()->width());
  std::atomic<uint32_t> next{0};
  const auto add_part = [&](uint32_t part, Places &places) {
    const uint32_t first = s.first + 2 * begin_of_part(part, parts, pairs);
    const uint32_t last = std::min(s.first + 2 * begin_of_part(part + 1, parts, pairs), s.last);
    gather(matrix, s, places_[0], first, last);
    const auto row = pattern_.row.begin();
    for (size_t c = pattern_.contribution_start[k]; c < pattern_.contribution_start[k + 1]; ++c) {
      Contribution of_part = pattern_.contribution[c];
      const auto begin = row + static_cast<std::ptrdiff_t>(of_part.first);
      const auto end = row + static_cast<std::ptrdiff_t>(of_part.in_columns);
      of_part.first = static_cast<size_t>(std::lower_bound(begin, end, first) - row);
      of_part.in_columns = static_cast<size_t>(std::lower_bound(begin, end, last) - row);
      if (of_part.first < of_part.in_columns) subtract(of_part, s, places_[0], places);
    }
  };
  workers()->parallel_for(workers()->width(), [&](uint32_t thread) {
    for (uint32_t part; (part = next++) < parts;) add_part(part, places_[1 + thread]);
  });
}

template <typename T>
bool BlockFactor<T>::factorise_panel_together(const Supernode &s) {
  const size_t width = 3 * s.width(), height = s.height();
  T *values = panel(s);
  for (size_t block = 0; block < width; block += panel_columns) {
    if (!factorise_square(values, width, height, block)) return false;
    const size_t below = rows_below(block, width, height), slices = (height - below) / panel_rows;
    const auto parts = static_cast<uint32_t>(std::min<size_t>(slices, 2 * workers()->width()));
    const auto row = [&](uint32_t part) {
      return below + panel_rows * begin_of_part(part, parts, slices);
    };
    workers()->parallel_for(parts, [&](uint32_t part) {
      factorise_rows(values, width, height, block, row(part), row(part + 1));
    });
  }
  finish_panel(values, width, height);
  return true;
}

// Subtrees, and parts of the rows above them with equally many numbers of the factor.
template <typename T>
void BlockFactor<T>::divide_solution() {
  const auto threads = static_cast<uint32_t>(workers()->width());
  if (is_solution_divided_ && local_of_thread_.size() == threads) return;
  is_solution_divided_ = true;
  local_of_thread_.resize(threads);
  for (auto &local : local_of_thread_) local.resize(local_.size());
  std::vector<double> work, of_row(x_.size() / 3, 0.0);
  for (const Supernode &s : pattern_.node) {
    work.push_back(static_cast<double>(3 * s.width() * s.height()));
  }
  solved_.divide(pattern_, work, solve_share);
  double whole = 0;
  for (uint32_t k = 0; k < pattern_.node.size(); ++k) {
    const Supernode &s = pattern_.node[k];
    for (size_t r = solved_.outer_rows(k); r < s.row_end; ++r) {
      of_row[pattern_.row[r]] += s.width();
      whole += s.width();
    }
  }
  part_of_row_.assign(of_row.size(), 0);
  double before = 0;
  for (size_t r = 0; r < of_row.size(); ++r) {
    const double part = whole > 0 ? before / whole * threads : 0;
    part_of_row_[r] = std::min(static_cast<uint32_t>(part), threads - 1);
    before += of_row[r];
  }
}

// Each number takes its products in the order of a single thread: those with columns of its subtree
// by the thread of the subtree, those of a row above by the thread of that row.
template <typename T>
void BlockFactor<T>::solve_together() {
  divide_solution();
  const auto threads = static_cast<uint32_t>(local_of_thread_.size());
  const auto for_groups = [&](const auto &solve) {
    std::atomic<uint32_t> next{0};
    workers()->parallel_for(threads, [&](uint32_t thread) {
      for (uint32_t group; (group = next++) < solved_.count();) {
        solve(solved_.begin(group), solved_.end(group), local_of_thread_[thread].data());
      }
    });
  };
  for_groups([&](const uint32_t *k, const uint32_t *end, T *local) {
    for (; k != end; ++k) solve_forward_at(pattern_.node[*k], solved_.outer_rows(*k), local);
  });
  uint32_t begin = 0;
  for (const uint32_t top : solved_.top()) {
    solve_outer_rows(begin, top);
    const Supernode &s = pattern_.node[top];
    solve_forward_at(s, s.row_end, local_.data());
    begin = top + 1;
  }
  for (size_t k = solved_.top().size(); k-- > 0;) {
    solve_backward_at(pattern_.node[solved_.top()[k]], local_.data());
  }
  for_groups([&](const uint32_t *first, const uint32_t *k, T *local) {
    while (k != first) solve_backward_at(pattern_.node[*--k], local);
  });
}

// Subtracts the products of supernodes begin .. end, in subtrees, from the rows above them.
template <typename T>
void BlockFactor<T>::solve_outer_rows(uint32_t begin, uint32_t end) {
  const auto subtract_at = [&](const Supernode &s, size_t row, size_t row_end, T *local) {
    T *to = local;
    for (size_t r = row; r < row_end; ++r, to += 3) copy_block(x_.data() + 3 * pattern_.row[r], to);
    subtract_rows(panel(s) + 3 * (s.width() + row - s.row_start), 3 * s.width(), s.height(),
                  3 * (row_end - row), x_.data() + 3 * s.first, local);
    const T *from = local;
    for (size_t r = row; r < row_end; ++r, from += 3) {
      copy_block(from, x_.data() + 3 * pattern_.row[r]);
    }
  };
  if (begin == end) return;
  const auto threads = static_cast<uint32_t>(local_of_thread_.size());
  workers()->parallel_for(threads, [&](uint32_t thread) {
    for (uint32_t k = begin; k < end; ++k) {
      const Supernode &s = pattern_.node[k];
      size_t row = solved_.outer_rows(k);
      while (row < s.row_end && part_of_row_[pattern_.row[row]] < thread) ++row;
      size_t row_end = row;
      while (row_end < s.row_end && part_of_row_[pattern_.row[row_end]] == thread) ++row_end;
      if (row < row_end) subtract_at(s, row, row_end, local_of_thread_[thread].data());
    }
  });
}

template bool BlockFactor<double>::factorise_together(const BlockMatrix &);
template void BlockFactor<double>::solve_together();
template bool BlockFactor<float>::factorise_together(const BlockMatrix &);
template void BlockFactor<float>::solve_together();

}  // namespace mvs::core
