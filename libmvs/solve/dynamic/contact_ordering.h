// An elimination order that depends on the model and on which patches of the sheet touch, on
// nothing else: cheap enough for every step, and the same for as long as the same patches touch.
//
// Free nodes are gathered into patches of a node and its neighbours. Patches couple where the terms
// of the model do, and where contact acts between their nodes; they are eliminated by minimum
// degree (Tinney & Walker, Proc. IEEE 55, 1967), each patch at once. Sets of patches are bits, so
// that an elimination is a few unions; all memory is there from the start.
#pragma once

#include <vector>

#include "energy/contact.h"

namespace mvs::core {

class ContactOrdering {
 public:
  // `pairs` of nodes that the terms of the model couple.
  ContactOrdering(const Model &model, const std::vector<Edge> &pairs);

  // Takes in what touches; true if the order is another one than before, or the first.
  bool update(const std::vector<ContactPair> &contact_pairs);
  // The free nodes in the order of their elimination.
  const std::vector<uint32_t> &nodes() const { return nodes_; }

 private:
  using Word = uint64_t;
  using Bits = std::vector<Word>;  // row by row, a bit for each patch

  void make_patches(const Model &model);
  void set(Bits &bits, uint32_t a, uint32_t b) const {
    bits[a * words_ + b / 64] |= Word{1} << (b % 64);
    bits[b * words_ + a / 64] |= Word{1} << (a % 64);
  }
  void couple(Bits &bits, uint32_t node_a, uint32_t node_b) const;
  template <typename Visit>
  void for_each(const Word *bits, Visit &&visit) const;
  uint32_t degree(uint32_t patch) const;
  void eliminate(uint32_t patch);
  void find_order();

  std::vector<uint32_t> patch_of_;                  // node -> patch, none where prescribed
  std::vector<uint32_t> patch_start_, patch_node_;  // nodes of each patch
  size_t words_ = 0;                                // of a row of bits
  Bits model_, touching_, touched_, graph_;
  std::vector<uint32_t> degree_;  // nodes next to each patch; none once it is eliminated
  std::vector<uint32_t> nodes_;
};

}  // namespace mvs::core
