// Supernodal left-looking Cholesky factorisation (Ng & Peyton, SIAM J. Sci. Comput. 14, 1993) of
// matrices of 3x3 blocks, for meshes of a few hundred to a few ten thousand nodes: a third of the
// index work of a scalar one, and dense arithmetic inside. Each panel gathers the contributions of
// the earlier ones in place, and is then factorised on its own.
#include "linalg/cholesky.h"

#include <algorithm>
#include <memory>
#include <type_traits>

#include "linalg/block_factor.h"

namespace mvs::core {

template <typename T>
void BlockFactor<T>::analyse(const BlockMatrix &matrix) {
  pattern_.analyse(matrix);
  size_t tallest = 0;
  for (const Supernode &s : pattern_.node) tallest = std::max(tallest, s.height());
  make_room(value_, 2 * pattern_.numbers + panel_slack);  // unused pages cost no memory
  make_room(work_, pattern_.node.size());
  if (places_.empty()) places_.resize(1);
  make_room(places_[0].target, matrix.size());
  for (auto *rows : {&x_, &local_}) make_room(*rows, 3 * matrix.size() + panel_slack);
  value_.resize(pattern_.numbers + panel_slack);
  places_[0].of_row.resize(matrix.size());
  places_[0].target.resize(matrix.size());
  x_.resize(3 * matrix.size());
  local_.resize(tallest + panel_slack);
  weigh();
  rows_.clear();
  way_.clear();
  is_divided_ = is_solution_divided_ = false;
}

// Counts products of blocks, with the cost of calls and copies in products.
template <typename T>
void BlockFactor<T>::weigh() {
  constexpr double call = 100;
  double sum = 0;
  work_.clear();
  for (size_t k = 0; k < pattern_.node.size(); ++k) {
    const Supernode &s = pattern_.node[k];
    const double width = s.width(), below = static_cast<double>(s.below());
    sum += call + width * width * (width / 6 + below / 2);
    for (size_t c = pattern_.contribution_start[k]; c < pattern_.contribution_start[k + 1]; ++c) {
      const Contribution &from = pattern_.contribution[c];
      const Supernode &source = pattern_.node[from.from];
      const auto columns = static_cast<double>(from.in_columns - from.first);
      const auto rows = static_cast<double>(source.row_end - from.first);
      sum += call + columns * (rows - columns / 2) * source.width();
    }
    work_.push_back(sum);
  }
}

// Returns the first supernode of a part.
template <typename T>
size_t BlockFactor<T>::begin_of(uint32_t part, uint32_t parts) const {
  if (part == parts) return work_.size();
  const double before = work_.empty() ? 0 : work_.back() * part / parts;
  return static_cast<size_t>(std::upper_bound(work_.begin(), work_.end(), before) - work_.begin());
}

template <typename T>
void BlockFactor<T>::locate(const Supernode &s, Places &places) {
  for (uint32_t j = s.first; j < s.last; ++j) places.of_row[j] = j - s.first;
  uint32_t at = s.width();
  for (size_t k = s.row_start; k < s.row_end; ++k) places.of_row[pattern_.row[k]] = at++;
}

// Copies columns first .. last of the matrix into the rows of the panel.
template <typename T>
void BlockFactor<T>::gather(const BlockMatrix &matrix, const Supernode &s, const Places &places,
                            uint32_t first, uint32_t last) {
  const size_t height = s.height();
  std::fill_n(panel(s) + 3 * (first - s.first) * height, 3 * (last - first) * height, T(0));
  for (uint32_t j = first; j < last; ++j) {
    T *column = panel(s) + 3 * (j - s.first) * height;
    for (uint32_t k = matrix.start[j]; k < matrix.start[j + 1]; ++k) {
      const double *from = matrix.value[k].data();
      T *to = column + 3 * places.of_row[matrix.row[k]];
      for (size_t c = 0; c < 3; ++c) {
        for (size_t r = 0; r < 3; ++r) to[c * height + r] = static_cast<T>(from[3 * c + r]);
      }
    }
  }
}

template <typename T>
void BlockFactor<T>::subtract(const Contribution &c, const Supernode &to, const Places &by_row,
                              Places &places) {
  const Supernode &from = pattern_.node[c.from];
  const size_t rows = from.row_end - c.first;
  for (size_t k = 0; k < rows; ++k) {
    places.target[k] = by_row.of_row[pattern_.row[c.first + k]];
  }
  const T *a = panel(from) + 3 * (from.width() + c.first - from.row_start);
  update_panel<T>({a, from.height(), panel(to), to.height(), places.target.data(), 3 * rows,
                   3 * (c.in_columns - c.first), 3 * from.width()});
}

template <typename T>
bool BlockFactor<T>::factorise_supernode(const BlockMatrix &matrix, size_t k, Places &places) {
  const Supernode &s = pattern_.node[k];
  locate(s, places);
  gather(matrix, s, places, s.first, s.last);
  for (size_t c = pattern_.contribution_start[k]; c < pattern_.contribution_start[k + 1]; ++c) {
    subtract(pattern_.contribution[c], s, places, places);
  }
  return factorise_panel(panel(s), 3 * s.width(), s.height());
}

template <typename T>
bool BlockFactor<T>::factorise_part(const BlockMatrix &matrix, uint32_t part, uint32_t parts) {
  const Rounding<T> rounding;
  for (size_t k = begin_of(part, parts); k < begin_of(part + 1, parts); ++k) {
    if (!factorise_supernode(matrix, k, places_[0])) return false;
  }
  if (is_compact_ && part + 1 == parts) compress();
  return true;
}

template <typename T>
bool BlockFactor<T>::factorise(const BlockMatrix &matrix) {
  if (is_compact_) return factorise_part(matrix, 0, 1);
  return pay_for(workers(), products() * block_product_us) ? factorise_together(matrix)
                                                           : factorise_part(matrix, 0, 1);
}

template <typename T>
void BlockFactor<T>::compress() {
  if constexpr (std::is_same_v<T, float>) {
    tiles_of_.clear();
    size_t words = 0;
    for (const Supernode &s : pattern_.node) {
      tiles_of_.push_back(words);
      words += compact_size(3 * s.width(), s.height());
    }
    make_room(tiles_, words);
    tiles_.resize(words);
    scale_.resize(x_.size());
    inverse_.resize(inverse_numbers * x_.size());
    for (size_t k = 0; k < pattern_.node.size(); ++k) {
      compress_panel(panel(pattern_.node[k]), compact(k));
    }
  }
}

// for shared_cholesky.cpp
template bool BlockFactor<double>::factorise_supernode(const BlockMatrix &, size_t, Places &);
template bool BlockFactor<float>::factorise_supernode(const BlockMatrix &, size_t, Places &);
template void BlockFactor<double>::locate(const Supernode &, Places &);
template void BlockFactor<float>::locate(const Supernode &, Places &);
template void BlockFactor<double>::gather(const BlockMatrix &, const Supernode &, const Places &,
                                          uint32_t, uint32_t);
template void BlockFactor<float>::gather(const BlockMatrix &, const Supernode &, const Places &,
                                         uint32_t, uint32_t);
template void BlockFactor<double>::subtract(const Contribution &, const Supernode &, const Places &,
                                            Places &);
template void BlockFactor<float>::subtract(const Contribution &, const Supernode &, const Places &,
                                           Places &);

std::unique_ptr<RowSolver> make_row_solver() {
  return std::make_unique<BlockFactor<double>>();
}

std::unique_ptr<DirectSolver> make_block_factor() {
  return std::make_unique<BlockFactor<double>>();
}

std::unique_ptr<DirectSolver> make_float_factor() {
  return std::make_unique<BlockFactor<float>>();
}

std::unique_ptr<DirectSolver> make_compact_factor() {
  return std::make_unique<BlockFactor<float>>(true);
}

}  // namespace mvs::core
