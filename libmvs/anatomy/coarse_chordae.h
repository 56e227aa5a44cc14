// Chordae of a valve whose sheet gets coarser: they move with the vertex that they end at.
#pragma once

#include <vector>

#include "model/model.h"

namespace mvs::core {

class CoarseChordae {
 public:
  explicit CoarseChordae(const Model &model);

  bool end_at(uint32_t vertex) const { return !at_[vertex].empty(); }
  bool sewn(uint32_t vertex) const;  // a suture ends here

  // Whether all that end at one vertex may end at another one: none without length, none twice
  // between the same nodes unless the two can be made one.
  bool may_move(uint32_t from, uint32_t to) const;

  // A rest length changes by as much as the distance of the ends at rest: the chord stays as slack,
  // or as taut, in millimetres. Two chordae of equal tissue that now join the same nodes become one
  // with the sum of their areas, as stiff and as taut as both together: A / L = A1 / L1 + A2 / L2.
  // It keeps the name and id of the first.
  void move(uint32_t from, uint32_t to);

  // Those that are left, in order.
  std::vector<Chord> left() const;
  // How many end elsewhere than before, those that are part of another one included, and the
  // farthest that an end went, m at rest.
  uint32_t moved() const;
  double largest_move() const;
  uint32_t merged() const;  // how many are part of another one

 private:
  double moved_length(const Chord &chord, uint32_t to) const;
  const Chord &whole(uint32_t chord) const;
  uint32_t same_ends(uint32_t chord, uint32_t to) const;

  const Model &model_;
  std::vector<Chord> chords_;
  std::vector<uint32_t> part_of_;          // itself, or another one that it is part of
  std::vector<std::vector<uint32_t>> at_;  // of each node, ascending
};

}  // namespace mvs::core
