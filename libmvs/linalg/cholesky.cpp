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

// The same for a number of a panel, of both solutions.
constexpr double number_us = 6e-4;

// Largest share of the work in a subtree that one thread factorises, and solves. A solution is so
// short that only few supernodes may wait for each other.
constexpr double factor_share = 1.0 / 24, solve_share = 1.0 / 6;

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
  void load(const Supernode &s, size_t row_end, T *to) const;
  void store_columns(const Supernode &s, const T *from);
  void store_rows(const Supernode &s, size_t row_end, const T *from);
  void solve_forward_at(const Supernode &s, size_t row_end, T *local);
  void solve_backward_at(const Supernode &s, T *local);
  void solve_together();
  void divide_solution();
  void solve_outer_rows(uint32_t begin, uint32_t end);

  Supernodes pattern_;
  std::vector<T> value_;      // all panels
  std::vector<T> x_;          // right-hand side, then solution
  std::vector<T> local_;      // right-hand side in the rows of one panel
  std::vector<double> work_;  // products up to the end of each supernode
  Places places_;
  // for several threads
  Subtrees subtrees_, solved_;  // of a factorisation, of a solution
  bool is_divided_ = false, is_solution_divided_ = false;
  std::vector<Places> of_thread_;
  std::vector<std::vector<T>> local_of_thread_;
  std::vector<uint32_t> part_of_row_;  // threads share the rows of the top
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
    subtrees_.divide(pattern_, work, factor_share);
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

// Its columns, and its rows up to `row_end`.
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

// Solves L y = b by columns, then L^T x = y; for doubles with the sums of each row from its last
// column on, an order that explicit zeros do not change.
template <typename T>
void BlockFactor<T>::solve(std::vector<Vec3> &b) {
  const Rounding<T> rounding;
  for (size_t j = 0; j < b.size(); ++j) Eigen::Map<Row>(x_.data() + 3 * j) = b[j].cast<T>();
  if (pay_for(workers(), number_us * static_cast<double>(pattern_.numbers))) {
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

}  // namespace

std::unique_ptr<DirectSolver> make_block_factor() {
  return std::make_unique<BlockFactor<double>>();
}

std::unique_ptr<DirectSolver> make_float_factor() {
  return std::make_unique<BlockFactor<float>>();
}

}  // namespace mvs::core
