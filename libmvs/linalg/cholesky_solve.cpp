// Solution with a Cholesky factor by one thread: forward and backward over the supernodes, each on
// a copy of its rows of the right-hand side.
#include <algorithm>
#include <type_traits>

#include "linalg/block_factor.h"

namespace mvs::core {

// Copies the numbers of x in the columns of a supernode, and in its rows up to `row_end`.
template <typename T>
void BlockFactor<T>::load(const Supernode &s, size_t row_end, T *to) const {
  for (uint32_t j = s.first; j < s.last; ++j, to += 3) copy_block(x_.data() + 3 * j, to);
  for (size_t k = s.row_start; k < row_end; ++k, to += 3) {
    copy_block(x_.data() + 3 * pattern_.row[k], to);
  }
}

template <typename T>
void BlockFactor<T>::store_columns(const Supernode &s, const T *from) {
  for (uint32_t j = s.first; j < s.last; ++j, from += 3) copy_block(from, x_.data() + 3 * j);
}

template <typename T>
void BlockFactor<T>::store_rows(const Supernode &s, size_t row_end, const T *from) {
  from += 3 * s.width();
  for (size_t k = s.row_start; k < row_end; ++k, from += 3) {
    copy_block(from, x_.data() + 3 * pattern_.row[k]);
  }
}

template <typename T>
void BlockFactor<T>::solve_forward_at(const Supernode &s, size_t row_end, T *local) {
  load(s, row_end, local);
  const size_t rows = s.width() + row_end - s.row_start;
  solve_forward_to(panel(s), 3 * s.width(), s.height(),
                   row_end == s.row_end ? s.height() : 3 * rows, local);
  store_columns(s, local);
  store_rows(s, row_end, local);
}

template <typename T>
void BlockFactor<T>::solve_backward_at(const Supernode &s, T *local) {
  load(s, s.row_end, local);
  solve_backward(panel(s), 3 * s.width(), s.height(), local);
  store_columns(s, local);
}

template <typename T>
void BlockFactor<T>::solve_compactly() {
  if constexpr (std::is_same_v<T, float>) {
    for (size_t k = 0; k < pattern_.node.size(); ++k) {
      const Supernode &s = pattern_.node[k];
      load(s, s.row_end, local_.data());
      solve_forward(compact(k), local_.data());
      store_columns(s, local_.data());
      store_rows(s, s.row_end, local_.data());
    }
    for (size_t k = pattern_.node.size(); k-- > 0;) {
      const Supernode &s = pattern_.node[k];
      load(s, s.row_end, local_.data());
      solve_backward(compact(k), local_.data());
      store_columns(s, local_.data());
    }
  }
}

// Solves L y = b by columns, then L^T x = y; for doubles with the sums of each row from its last
// column on, an order that explicit zeros do not change.
template <typename T>
void BlockFactor<T>::solve(std::vector<Vec3> &b) {
  const Rounding<T> rounding;
  for (size_t j = 0; j < b.size(); ++j) Eigen::Map<Row>(x_.data() + 3 * j) = b[j].cast<T>();
  if (is_compact_) {
    solve_compactly();
  } else if (pay_for(workers(), panel_number_us * static_cast<double>(pattern_.numbers))) {
    solve_together();
  } else {
    for (const Supernode &s : pattern_.node) solve_forward_at(s, s.row_end, local_.data());
    for (size_t k = pattern_.node.size(); k-- > 0;) {
      solve_backward_at(pattern_.node[k], local_.data());
    }
  }
  for (size_t j = 0; j < b.size(); ++j) {
    b[j] = Eigen::Map<const Row>(x_.data() + 3 * j).template cast<double>();
  }
}

template <typename T>
void BlockFactor<T>::choose_rows(const std::vector<uint32_t> &rows) {
  rows_ = rows;
  way_.clear();
  std::vector<uint8_t> is_on_way(x_.size() / 3, 0);  // a row of a supernode on the way
  for (const uint32_t r : rows) is_on_way[r] = 1;
  for (uint32_t k = 0; k < pattern_.node.size(); ++k) {
    const Supernode &s = pattern_.node[k];
    const auto first = is_on_way.begin() + s.first, last = is_on_way.begin() + s.last;
    if (std::find(first, last, 1) == last) continue;
    way_.push_back(k);
    if (s.below() > 0) is_on_way[pattern_.row[s.row_start]] = 1;
  }
}

template <typename T>
void BlockFactor<T>::solve_rows(std::vector<Vec3> &b) {
  const Rounding<T> rounding;
  std::fill(x_.begin(), x_.end(), T(0));
  for (size_t k = 0; k < rows_.size(); ++k) {
    Eigen::Map<Row>(x_.data() + 3 * rows_[k]) = b[k].cast<T>();
  }
  for (const uint32_t k : way_) {
    solve_forward_at(pattern_.node[k], pattern_.node[k].row_end, local_.data());
  }
  for (size_t i = way_.size(); i-- > 0;) {
    solve_backward_at(pattern_.node[way_[i]], local_.data());
  }
  for (size_t k = 0; k < rows_.size(); ++k) {
    b[k] = Eigen::Map<const Row>(x_.data() + 3 * rows_[k]).template cast<double>();
  }
}

template void BlockFactor<double>::solve(std::vector<Vec3> &);
template void BlockFactor<float>::solve(std::vector<Vec3> &);
template void BlockFactor<double>::choose_rows(const std::vector<uint32_t> &);
template void BlockFactor<float>::choose_rows(const std::vector<uint32_t> &);
template void BlockFactor<double>::solve_rows(std::vector<Vec3> &);
template void BlockFactor<float>::solve_rows(std::vector<Vec3> &);

// for shared_cholesky.cpp
template void BlockFactor<double>::solve_forward_at(const Supernode &, size_t, double *);
template void BlockFactor<float>::solve_forward_at(const Supernode &, size_t, float *);
template void BlockFactor<double>::solve_backward_at(const Supernode &, double *);
template void BlockFactor<float>::solve_backward_at(const Supernode &, float *);

}  // namespace mvs::core
