// Numbers the rows of the free nodes, builds block patterns and finds the place of each block.
#include "energy/hessian_assembler.h"

#include <algorithm>
#include <iterator>

#include "energy/settings.h"
#include "linalg/direct_solver.h"
#include "linalg/nested_dissection.h"

namespace mvs::core {
void HessianAssembler::set_pattern(const Model &model, const std::vector<Edge> &pairs) {
  slots_.clear();
  if (!keeps_order_) number_rows(model, pairs);
  take_rows(pairs);
  keep_old_rows();
  matrix.take_sorted(static_cast<uint32_t>(node_of.size()), rows_);
}

void HessianAssembler::set_pattern(const Model &model, const std::vector<Edge> &always,
                                   const std::vector<Edge> &beside) {
  if (!keeps_order_) {
    std::vector<Edge> pairs = always;
    pairs.insert(pairs.end(), beside.begin(), beside.end());
    number_rows(model, pairs);
  }
  if (always_of_.size() != always.size()) find_always(always);
  take_rows(beside);
  unite(always_);
  keep_old_rows();
  matrix.take_sorted(static_cast<uint32_t>(node_of.size()), rows_);
  place_always();
}

// Sorts the fixed pairs and finds the place of each in the sorted list, column by column with the
// places of its rows at hand; valid while rows keep their order.
void HessianAssembler::find_always(const std::vector<Edge> &pairs) {
  const size_t n = node_of.size();
  // the column of its block, which is the smaller index, and the row
  std::vector<Edge> blocks;
  blocks.reserve(pairs.size());
  for (const Edge &pair : pairs) {
    const auto [c, r] = std::minmax(row_of[pair[0]], row_of[pair[1]]);
    blocks.push_back({c, r});
  }
  const Rows of_column = build_rows(n, [&](auto visit) {
    for (uint32_t k = 0; k < blocks.size(); ++k) {
      if (blocks[k][1] != none) visit(blocks[k][0], k);
    }
  });
  std::vector<uint32_t> seen_in(n, none), of_row(n);  // a column with this row; the last place
  always_.clear();
  always_of_.assign(pairs.size(), none);
  for (uint32_t c = 0; c < n; ++c) {
    const auto first = static_cast<uint32_t>(always_.size());
    for (const uint32_t k : of_column[c]) {
      const uint32_t r = blocks[k][1];
      if (seen_in[r] != c) always_.push_back(blocks[k]);
      seen_in[r] = c;
    }
    std::sort(always_.begin() + first, always_.end());
    for (uint32_t i = first; i < always_.size(); ++i) of_row[always_[i][1]] = i;
    for (const uint32_t k : of_column[c]) always_of_[k] = of_row[blocks[k][1]];
  }
}

// Finds the blocks of the fixed pairs in the matrix; both lists ascend.
void HessianAssembler::place_always() {
  place_.resize(always_.size());
  for (uint32_t i = 0, k = 0; i < always_.size(); ++i) {
    const auto [c, r] = always_[i];
    k = std::max(k, matrix.start[c]);
    while (matrix.row[k] < r) ++k;
    place_[i] = k;
  }
  slots_.resize(always_of_.size());
  for (size_t k = 0; k < slots_.size(); ++k) {
    slots_[k] = always_of_[k] == none ? none : place_[always_of_[k]];
  }
}

// Adds sorted pairs of rows to those of the pattern.
void HessianAssembler::unite(const std::vector<Edge> &other) {
  united_.clear();
  make_room(united_, rows_.size() + other.size());
  std::set_union(rows_.begin(), rows_.end(), other.begin(), other.end(),
                 std::back_inserter(united_));
  rows_.swap(united_);
}

// Adds the pairs of the old pattern, unless the pattern then grows beyond its limit.
void HessianAssembler::keep_old_rows() {
  if (!keeps_order_ || matrix.size() != node_of.size()) return;
  const auto needed = settings::assembly::max_pattern_growth * static_cast<double>(rows_.size());
  old_.clear();
  make_room(old_, matrix.row.size());
  for (uint32_t c = 0; c < matrix.size(); ++c) {
    for (uint32_t k = matrix.start[c] + 1; k < matrix.start[c + 1]; ++k) {
      old_.push_back({c, matrix.row[k]});
    }
  }
  unite(old_);
  if (static_cast<double>(rows_.size()) > needed) rows_.swap(united_);
}

// Adds an outer product block by block.
template <typename Assembler>
static void add_blocks(Assembler &assembler, size_t k, const std::array<uint32_t, 4> &nodes,
                       const Slope &slope, double times) {
  for (uint32_t a = 0; a < 4; ++a) {
    const Vec3 of_a = slope.node(a);
    assembler.add_diagonal(nodes[a], times * (of_a * of_a.transpose()));
    for (uint32_t b = 0; b < a; ++b, ++k) {
      assembler.add(k, nodes[a], nodes[b], times * (of_a * slope.node(b).transpose()));
    }
  }
}

// Finds the blocks of an outer product. Returns false unless all are in the matrix.
bool HessianAssembler::find_outer_product(size_t first, size_t k,
                                          const std::array<uint32_t, 4> &nodes,
                                          OuterProductTarget &to) {
  if (slots_.empty()) return false;
  std::array<uint32_t, 4> row;
  for (uint32_t a = 0; a < 4; ++a) row[a] = row_of[nodes[a]];
  const uint32_t *slot = slots_.data() + first + k;
  for (uint32_t a = 0, pair = 0; a < 4; ++a) {
    if (row[a] == none) return false;
    to.diagonal[a] = matrix.value[matrix.start[row[a]]].data();
    for (uint32_t b = 0; b < a; ++b, ++pair) {
      to.lower[pair] = row[a] > row[b];
      to.pair[pair] = matrix.value[slot[pair]].data();
    }
  }
  return true;
}

void HessianAssembler::add_outer_product(size_t k, const std::array<uint32_t, 4> &nodes,
                                         const Slope &slope, double times) {
  OuterProductTarget to;
  if (find_outer_product(first_, k, nodes, to)) {
    mvs::core::add_outer_product(slope, times, to);
    return;
  }
  add_blocks(*this, k, nodes, slope, times);
}

void HessianPart::clear() {
  BlockMatrix &m = assembler_->matrix;
  for (uint32_t r = 0; r < m.size(); ++r) {
    if (!part_.has(assembler_->node_of[r])) continue;
    for (uint32_t k = m.start[r]; k < m.start[r + 1]; ++k) m.value[k].setZero();
    assembler_->boundary_force[r].setZero();
  }
}

bool HessianPart::add(uint32_t i, uint32_t j, const Mat3 &block) {
  const uint32_t r = assembler_->row_of[i], c = assembler_->row_of[j];
  if (r == none || c == none) {
    couple(i, j, block);
    return true;
  }
  const uint32_t slot = assembler_->find(r, c);
  if (slot == none) return false;
  if (has_column(r, c)) assembler_->add_at(slot, r > c, block);
  return true;
}

void HessianPart::add(size_t k, uint32_t i, uint32_t j, const Mat3 &block) {
  if (assembler_->slots_.empty()) {
    add(i, j, block);
    return;
  }
  const uint32_t slot = assembler_->slots_[first_ + k];
  if (slot == none) {
    couple(i, j, block);
    return;
  }
  const uint32_t r = assembler_->row_of[i], c = assembler_->row_of[j];
  if (has_column(r, c)) assembler_->add_at(slot, r > c, block);
}

void HessianPart::couple(uint32_t i, uint32_t j, const Mat3 &block) const {
  if (assembler_->boundary_step == nullptr) return;
  const std::vector<Vec3> &step = *assembler_->boundary_step;
  const uint32_t r = assembler_->row_of[i], c = assembler_->row_of[j];
  if (r != none && part_.has(i)) assembler_->boundary_force[r] -= block * step[j];
  if (c != none && part_.has(j)) assembler_->boundary_force[c] -= block.transpose() * step[i];
}

// Blocks of other parts are written to `aside`, which is not read.
void HessianPart::add_outer_product(size_t k, const std::array<uint32_t, 4> &nodes,
                                    const Slope &slope, double times) {
  OuterProductTarget to;
  if (assembler_->find_outer_product(first_, k, nodes, to)) {
    std::array<double, 10> aside{};
    for (uint32_t a = 0, pair = 0; a < 4; ++a) {
      if (!part_.has(nodes[a])) to.diagonal[a] = aside.data();
      for (uint32_t b = 0; b < a; ++b, ++pair) {
        if (!has_column(assembler_->row_of[nodes[a]], assembler_->row_of[nodes[b]])) {
          to.pair[pair] = aside.data();
        }
      }
    }
    mvs::core::add_outer_product(slope, times, to);
    return;
  }
  add_blocks(*this, k, nodes, slope, times);
}

void HessianAssembler::set_order(const Model &model, const std::vector<uint32_t> &nodes) {
  keeps_order_ = true;
  node_of = nodes;
  row_of.assign(model.node_count(), none);
  for (uint32_t r = 0; r < node_of.size(); ++r) row_of[node_of[r]] = r;
  always_of_.clear();
  matrix.forget_pattern();
}

// Collects the pairs of free nodes as sorted pairs of rows.
void HessianAssembler::take_rows(const std::vector<Edge> &pairs) {
  rows_.clear();
  for (const Edge &p : pairs) {
    const uint32_t r = row_of[p[0]], c = row_of[p[1]];
    if (r != none && c != none) rows_.push_back({r, c});
  }
  matrix.sort_pairs(static_cast<uint32_t>(node_of.size()), rows_);
}

// Returns the order of elimination, minimum degree or nested dissection, that needs less work.
// `pairs` are indices into `nodes`.
std::vector<uint32_t> HessianAssembler::order_of(const std::vector<uint32_t> &nodes,
                                                 const std::vector<Edge> &pairs) const {
  std::vector<uint32_t> order = fill_reducing_order(static_cast<uint32_t>(nodes.size()), pairs);
  if (place == nullptr || nodes.size() < settings::assembly::min_dissection_rows) return order;
  std::vector<Vec3> places;
  places.reserve(nodes.size());
  for (const uint32_t i : nodes) places.push_back((*place)[i]);
  std::vector<uint32_t> dissected = nested_dissection_order(pairs, places);
  return elimination_work(dissected, pairs) < elimination_work(order, pairs) ? dissected : order;
}

void HessianAssembler::number_rows(const Model &model, const std::vector<Edge> &pairs) {
  const auto n = static_cast<uint32_t>(model.node_count());
  std::vector<uint32_t> free_index(n, none), free_nodes;
  for (uint32_t i = 0; i < n; ++i) {
    if (model.topology.fixed[i]) continue;
    free_index[i] = static_cast<uint32_t>(free_nodes.size());
    free_nodes.push_back(i);
  }
  std::vector<Edge> free_pairs;
  free_pairs.reserve(pairs.size());
  for (const Edge &p : pairs) {
    if (free_index[p[0]] != none && free_index[p[1]] != none) {
      free_pairs.push_back({free_index[p[0]], free_index[p[1]]});
    }
  }
  const auto rows = static_cast<uint32_t>(free_nodes.size());
  matrix.sort_pairs(rows, free_pairs);
  const std::vector<uint32_t> order = order_of(free_nodes, free_pairs);
  always_of_.clear();
  row_of.assign(n, none);
  node_of.resize(rows);
  for (uint32_t k = 0; k < rows; ++k) {
    node_of[k] = free_nodes[order[k]];
    row_of[node_of[k]] = k;
  }
}

}  // namespace mvs::core
