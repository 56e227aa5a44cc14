// Numbering the rows of the system.
#include "physics/system.h"

#include <algorithm>

#include "base/factor.h"

namespace mvs {
namespace {

// Times the blocks that are needed: more are not kept from one pattern to the next.
constexpr double most_kept = 1.25;

}  // namespace

void System::set_pattern(const Model &model, const std::vector<Edge> &pairs) {
  if (!keeps_order_) number_rows(model, pairs);
  take_rows(pairs);
  const auto rows = static_cast<uint32_t>(node_of.size());
  if (keeps_order_ && matrix.size() == rows) {
    const auto needed = most_kept * static_cast<double>(rows_.size());
    for (uint32_t c = 0; c < rows; ++c) {
      for (uint32_t k = matrix.start[c] + 1; k < matrix.start[c + 1]; ++k) {
        rows_.push_back({c, matrix.row[k]});
      }
    }
    sort_rows();
    if (static_cast<double>(rows_.size()) > needed) take_rows(pairs);
  }
  matrix.take_pattern(rows, rows_);
}

void System::set_order(const Model &model, const std::vector<uint32_t> &nodes) {
  keeps_order_ = true;
  node_of = nodes;
  row_of.assign(model.node_count(), none);
  for (uint32_t r = 0; r < node_of.size(); ++r) row_of[node_of[r]] = r;
  matrix.forget_pattern();
}

// The pairs of free nodes, by their rows.
void System::take_rows(const std::vector<Edge> &pairs) {
  rows_.clear();
  for (const Edge &p : pairs) {
    const uint32_t r = row_of[p[0]], c = row_of[p[1]];
    if (r != none && c != none) rows_.push_back({r, c});
  }
  sort_rows();
}

// As BlockMatrix::sort_pairs does, in linear time: by the higher row, then, keeping that order, by
// the lower one.
void System::sort_rows() {
  for (Edge &p : rows_) p = {std::min(p[0], p[1]), std::max(p[0], p[1])};
  halfway_.resize(rows_.size());
  for (const size_t key : {1u, 0u}) {
    count_.assign(node_of.size() + 1, 0);
    for (const Edge &p : rows_) ++count_[p[key] + 1];
    for (size_t r = 0; r < node_of.size(); ++r) count_[r + 1] += count_[r];
    for (const Edge &p : rows_) halfway_[count_[p[key]]++] = p;
    rows_.swap(halfway_);
  }
  rows_.erase(std::unique(rows_.begin(), rows_.end()), rows_.end());
}

void System::number_rows(const Model &model, const std::vector<Edge> &pairs) {
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
  const std::vector<uint32_t> order = fill_reducing_order(rows, free_pairs);
  row_of.assign(n, none);
  node_of.resize(rows);
  for (uint32_t k = 0; k < rows; ++k) {
    node_of[k] = free_nodes[order[k]];
    row_of[node_of[k]] = k;
  }
}

}  // namespace mvs
