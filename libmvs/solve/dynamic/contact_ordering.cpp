// Patches of nodes, their coupling as bit sets, and minimum degree over the patches.
#include "solve/dynamic/contact_ordering.h"

#include <algorithm>
#include <bit>

namespace mvs::core {

ContactOrdering::ContactOrdering(const Model &model, const std::vector<Edge> &pairs) {
  make_patches(model);
  const size_t patches = patch_start_.size() - 1;
  words_ = (patches + 63) / 64;
  model_.assign(patches * words_, 0);
  touching_ = touched_ = graph_ = model_;
  for (const Edge &p : pairs) couple(model_, p[0], p[1]);
  degree_.resize(patches);
  nodes_.reserve(patch_node_.size());
}

// Builds each patch from a node without a patch and its neighbours, along edges and chordae,
// without a patch. Smaller patches cost more and fill no less (measured with at most three nodes).
void ContactOrdering::make_patches(const Model &model) {
  const auto n = static_cast<uint32_t>(model.node_count());
  std::vector<std::vector<uint32_t>> around(n);
  const auto join = [&](uint32_t i, uint32_t j) {
    around[i].push_back(j);
    around[j].push_back(i);
  };
  for (const Edge &e : model.topology.edges) join(e[0], e[1]);
  for (const Chord &c : model.valve.chords) join(c.a, c.b);
  patch_of_.assign(n, none);
  patch_start_.push_back(0);
  for (uint32_t i = 0; i < n; ++i) {
    if (model.topology.fixed[i] || patch_of_[i] != none) continue;
    const auto patch = static_cast<uint32_t>(patch_start_.size() - 1);
    patch_of_[i] = patch;
    patch_node_.push_back(i);
    for (const uint32_t j : around[i]) {
      if (model.topology.fixed[j] || patch_of_[j] != none) continue;
      patch_of_[j] = patch;
      patch_node_.push_back(j);
    }
    patch_start_.push_back(static_cast<uint32_t>(patch_node_.size()));
  }
}

void ContactOrdering::couple(Bits &bits, uint32_t node_a, uint32_t node_b) const {
  const uint32_t a = patch_of_[node_a], b = patch_of_[node_b];
  if (a != none && b != none && a != b) set(bits, a, b);
}

bool ContactOrdering::update(const std::vector<ContactPair> &contact_pairs) {
  std::fill(touching_.begin(), touching_.end(), 0);
  for (const ContactPair &s : contact_pairs) {
    for (uint32_t k = 0; k < s.count; ++k) {
      for (uint32_t l = 0; l < k; ++l) couple(touching_, s.node[k], s.node[l]);
    }
  }
  if (!nodes_.empty() && touching_ == touched_) return false;
  touched_.swap(touching_);
  find_order();
  return true;
}

template <typename Visit>
void ContactOrdering::for_each(const Word *bits, Visit &&visit) const {
  for (size_t w = 0; w < words_; ++w) {
    for (Word left = bits[w]; left != 0; left &= left - 1) {
      visit(static_cast<uint32_t>(64 * w) + static_cast<uint32_t>(std::countr_zero(left)));
    }
  }
}

uint32_t ContactOrdering::degree(uint32_t patch) const {
  uint32_t sum = 0;
  for_each(&graph_[patch * words_],
           [&](uint32_t p) { sum += patch_start_[p + 1] - patch_start_[p]; });
  return sum;
}

// Eliminates a patch: its neighbours become adjacent to each other.
void ContactOrdering::eliminate(uint32_t patch) {
  const Word *gone = &graph_[patch * words_];
  for_each(gone, [&](uint32_t p) {
    Word *row = &graph_[p * words_];
    for (size_t w = 0; w < words_; ++w) row[w] |= gone[w];
    row[p / 64] &= ~(Word{1} << (p % 64));
    row[patch / 64] &= ~(Word{1} << (patch % 64));
    degree_[p] = degree(p);
  });
  degree_[patch] = none;
  nodes_.insert(nodes_.end(), patch_node_.begin() + patch_start_[patch],
                patch_node_.begin() + patch_start_[patch + 1]);
}

void ContactOrdering::find_order() {
  const auto patches = static_cast<uint32_t>(degree_.size());
  for (size_t w = 0; w < graph_.size(); ++w) graph_[w] = model_[w] | touched_[w];
  for (uint32_t p = 0; p < patches; ++p) degree_[p] = degree(p);
  nodes_.clear();
  for (uint32_t k = 0; k < patches; ++k) {
    const auto least = std::min_element(degree_.begin(), degree_.end());
    eliminate(static_cast<uint32_t>(least - degree_.begin()));
  }
}

}  // namespace mvs::core
