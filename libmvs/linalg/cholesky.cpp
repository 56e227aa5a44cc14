// Supernodal left-looking Cholesky factorisation (Ng & Peyton, SIAM J. Sci. Comput. 14, 1993) of
// matrices of 3x3 blocks, for meshes of a few hundred to a few ten thousand nodes: a third of the
// index work of a scalar one, and dense arithmetic inside. Each panel gathers the contributions of
// the earlier ones in place, and is then factorised on its own.
//
// Several threads factorise disjoint subtrees of the elimination tree, then share the columns and
// rows of each panel above them. A panel has the same bits whoever computes it and in which parts.
#include "linalg/cholesky.h"

#include <algorithm>
#include <atomic>
#include <numeric>

#include "base/denormals.h"
#include "linalg/panel.h"
#include "linalg/subtrees.h"
#include "linalg/symbolic.h"

namespace mvs::core {
namespace {

// State of the processor during work on panels of T.
template <typename T>
struct Rounding {
  Rounding() {}  // not trivial: no warning of an unused object
};
template <>
struct Rounding<float> : FlushDenormals {};

// Microseconds for a product of blocks in single precision, about.
constexpr double product_us = 1.2e-3;

// Places of rows in the current panel, of one thread.
struct Places {
  std::vector<uint32_t> of_row;  // block row -> its place in the current panel
  std::vector<uint32_t> target;  // rows of a contribution in the current panel
};

// Panels of double, or of float as a preconditioner.
template <typename T>
class BlockFactor final : public DirectSolver {
 public:
  void analyse(const BlockMatrix &matrix) override;
  bool factorise(const BlockMatrix &matrix) override;
  bool factorise_part(const BlockMatrix &matrix, uint32_t part, uint32_t parts) override;
  void solve(std::vector<Vec3> &b) override;

 private:
  using Row = Eigen::Matrix<T, 3, 1>;
  T *panel(const Supernode &s) { return value_.data() + s.panel; }
  void weigh();
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
  void load(const Supernode &s);
  void store_columns(const Supernode &s);
  void store_rows(const Supernode &s);

  Supernodes pattern_;
  std::vector<T> value_;      // all panels
  std::vector<T> x_;          // right-hand side, then solution
  std::vector<T> local_;      // right-hand side in the rows of one panel
  std::vector<double> work_;  // products up to the end of each supernode
  Places places_;
  // for several threads
  Subtrees subtrees_;
  bool is_divided_ = false;
  std::vector<Places> of_thread_;
};

template <typename T>
void BlockFactor<T>::analyse(const BlockMatrix &matrix) {
  pattern_.analyse(matrix);
  size_t tallest = 0;
  for (const Supernode &s : pattern_.node) tallest = std::max(tallest, s.height());
  make_room(value_, 2 * pattern_.numbers + panel_slack);  // unused pages cost no memory
  make_room(work_, pattern_.node.size());
  make_room(places_.target, matrix.size());
  for (auto *rows : {&x_, &local_}) make_room(*rows, 3 * matrix.size() + panel_slack);
  value_.resize(pattern_.numbers + panel_slack);
  places_.of_row.resize(matrix.size());
  places_.target.resize(matrix.size());
  x_.resize(3 * matrix.size());
  local_.resize(tallest + panel_slack);
  weigh();
  is_divided_ = false;
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
    if (!factorise_supernode(matrix, k, places_)) return false;
  }
  return true;
}

template <typename T>
bool BlockFactor<T>::factorise(const BlockMatrix &matrix) {
  const double products = work_.empty() ? 0 : work_.back();
  return pay_for(workers(), products * product_us) ? factorise_together(matrix)
                                                   : factorise_part(matrix, 0, 1);
}

template <typename T>
void BlockFactor<T>::divide() {
  if (!is_divided_) {
    std::vector<double> work(work_.size());
    std::adjacent_difference(work_.begin(), work_.end(), work.begin());
    subtrees_.divide(pattern_, work);
    is_divided_ = true;
  }
  of_thread_.resize(workers()->width());
  for (Places &places : of_thread_) {
    places.of_row.resize(places_.of_row.size());
    places.target.resize(places_.of_row.size());
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
    if (!pay_for(workers(), products * product_us)) {
      if (!factorise_supernode(matrix, k, places_)) return false;
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
  workers()->parallel_for(static_cast<uint32_t>(of_thread_.size()), [&](uint32_t thread) {
    for (uint32_t group; (group = next++) < subtrees_.count();) {
      for (const uint32_t *k = subtrees_.begin(group); k != subtrees_.end(group); ++k) {
        if (!is_positive) return;
        if (!factorise_supernode(matrix, *k, of_thread_[thread])) is_positive = false;
      }
    }
  });
  return is_positive;
}

// Columns of the matrix and contributions of earlier panels, some columns at a time.
template <typename T>
void BlockFactor<T>::assemble_together(const BlockMatrix &matrix, size_t k) {
  const Supernode &s = pattern_.node[k];
  locate(s, places_);
  // an even number of blocks fills the tiles of a kernel
  const uint32_t pairs = (s.width() + 1) / 2;
  const uint32_t parts = std::min(pairs, 4 * static_cast<uint32_t>(of_thread_.size()));
  std::atomic<uint32_t> next{0};
  const auto add_part = [&](uint32_t part, Places &places) {
    const uint32_t first = s.first + 2 * begin_of_part(part, parts, pairs);
    const uint32_t last = std::min(s.first + 2 * begin_of_part(part + 1, parts, pairs), s.last);
    gather(matrix, s, places_, first, last);
    const auto row = pattern_.row.begin();
    for (size_t c = pattern_.contribution_start[k]; c < pattern_.contribution_start[k + 1]; ++c) {
      Contribution of_part = pattern_.contribution[c];
      const auto begin = row + static_cast<std::ptrdiff_t>(of_part.first);
      const auto end = row + static_cast<std::ptrdiff_t>(of_part.in_columns);
      of_part.first = static_cast<size_t>(std::lower_bound(begin, end, first) - row);
      of_part.in_columns = static_cast<size_t>(std::lower_bound(begin, end, last) - row);
      if (of_part.first < of_part.in_columns) subtract(of_part, s, places_, places);
    }
  };
  workers()->parallel_for(static_cast<uint32_t>(of_thread_.size()), [&](uint32_t thread) {
    for (uint32_t part; (part = next++) < parts;) add_part(part, of_thread_[thread]);
  });
}

template <typename T>
bool BlockFactor<T>::factorise_panel_together(const Supernode &s) {
  const size_t width = 3 * s.width(), height = s.height();
  T *values = panel(s);
  for (size_t block = 0; block < width; block += panel_columns) {
    if (!factorise_square(values, width, height, block)) return false;
    const size_t below = rows_below(block, width, height), slices = (height - below) / panel_rows;
    const auto parts = static_cast<uint32_t>(std::min(slices, 2 * of_thread_.size()));
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

// Copies three numbers at a time: most panels have only a few rows.
template <typename T>
void copy_block(const T *from, T *to) {
  for (size_t c = 0; c < 3; ++c) to[c] = from[c];
}

template <typename T>
void BlockFactor<T>::load(const Supernode &s) {
  T *to = local_.data();
  for (uint32_t j = s.first; j < s.last; ++j, to += 3) copy_block(x_.data() + 3 * j, to);
  for (size_t k = s.row_start; k < s.row_end; ++k, to += 3) {
    copy_block(x_.data() + 3 * pattern_.row[k], to);
  }
}

template <typename T>
void BlockFactor<T>::store_columns(const Supernode &s) {
  const T *from = local_.data();
  for (uint32_t j = s.first; j < s.last; ++j, from += 3) copy_block(from, x_.data() + 3 * j);
}

template <typename T>
void BlockFactor<T>::store_rows(const Supernode &s) {
  const T *from = local_.data() + 3 * s.width();
  for (size_t k = s.row_start; k < s.row_end; ++k, from += 3) {
    copy_block(from, x_.data() + 3 * pattern_.row[k]);
  }
}

// Solves L y = b by columns, then L^T x = y; for doubles with the sums of each row from its last
// column on, an order that explicit zeros do not change.
template <typename T>
void BlockFactor<T>::solve(std::vector<Vec3> &b) {
  const Rounding<T> rounding;
  for (size_t j = 0; j < b.size(); ++j) Eigen::Map<Row>(x_.data() + 3 * j) = b[j].cast<T>();
  for (const Supernode &s : pattern_.node) {
    load(s);
    solve_forward(panel(s), 3 * s.width(), s.height(), local_.data());
    store_columns(s);
    store_rows(s);
  }
  for (size_t k = pattern_.node.size(); k-- > 0;) {
    const Supernode &s = pattern_.node[k];
    load(s);
    solve_backward(panel(s), 3 * s.width(), s.height(), local_.data());
    store_columns(s);
  }
  for (size_t j = 0; j < b.size(); ++j) {
    b[j] = Eigen::Map<const Row>(x_.data() + 3 * j).template cast<double>();
  }
}

}  // namespace

std::unique_ptr<DirectSolver> make_block_factor() {
  return std::make_unique<BlockFactor<double>>();
}

std::unique_ptr<DirectSolver> make_float_factor() {
  return std::make_unique<BlockFactor<float>>();
}

}  // namespace mvs::core
