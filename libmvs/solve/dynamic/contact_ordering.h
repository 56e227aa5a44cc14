// Minimum-degree elimination order on patches of nodes (Tinney & Walker, Proc. IEEE 55, 1967). It
// depends on the model and on which patches touch only, so it stays the same while the same patches
// touch, and is cheap enough for every step.
//
// A patch is a node with its neighbours. Patches couple where terms of the model couple their nodes
// or contact acts between them; each patch is eliminated at once. Sets of patches are bit sets, so
// that an elimination is a few unions. All memory is allocated by the constructor. An order from
// the mesh alone fills the factor three to four times as much once the leaflets close.
#pragma once

#include <vector>

#include "energy/contact.h"

namespace mvs::core {

class ContactOrdering {
 public:
  // `pairs` are the nodes that terms with a fixed pattern couple.
  ContactOrdering(const Model &model, const std::vector<Edge> &pairs);

  // Updates the order for these contact pairs. Returns true if it changed or is the first.
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
  std::vector<uint32_t> degree_;  // nodes adjacent to each patch; none once it is eliminated
  std::vector<uint32_t> nodes_;
};

}  // namespace mvs::core
