// Chordae of a valve during coarsening: they move with the vertex at which they end.
#pragma once

#include <vector>

#include "model/model.h"

namespace mvs::core {

// A step of a coarsening that concerns chordae, of one vertex to another.
struct ChordStep {
  enum Kind : uint8_t { refused, allowed, moved };
  uint32_t from, to;
  Kind kind;
};

class CoarseChordae {
 public:
  explicit CoarseChordae(const Model &model);

  bool end_at(uint32_t vertex) const { return !at_[vertex].empty(); }
  bool sewn(uint32_t vertex) const;  // a suture ends here

  // Returns whether all chordae of one vertex may move to another: each keeps a length, and pairs
  // with equal ends can be merged.
  bool may_move(uint32_t from, uint32_t to);

  // Moves all chordae of a vertex. A rest length changes by the change of the distance between its
  // ends at rest, so that the slack in millimetres stays. Two chordae of equal tissue with equal
  // ends are merged: areas add up, and A / L = A1 / L1 + A2 / L2 keeps stiffness and tautness. The
  // merged chord has the name and id of the first.
  void move(uint32_t from, uint32_t to);

  // The answers of may_move() and the moves so far, in their order. All else in a coarsening
  // depends on the mesh alone.
  const std::vector<ChordStep> &steps() const { return steps_; }
  // Makes the moves of another coarsening of the same mesh. Returns false, and is then useless, if
  // may_move() answers otherwise for these chordae.
  bool repeat(const std::vector<ChordStep> &steps);

  // Returns the remaining chordae, in order.
  std::vector<Chord> left() const;
  // Number of chordae with another end than before (merged ones included), and the largest
  // displacement of an end, m at rest.
  uint32_t moved() const;
  double largest_move() const;
  uint32_t merged() const;  // number of chordae merged into another one

 private:
  uint32_t far_end(const Chord &chord) const;
  double moved_length(const Chord &chord, uint32_t to) const;
  const Chord &whole(uint32_t chord) const;
  uint32_t same_ends(uint32_t chord, uint32_t to) const;
  bool can_move(uint32_t from, uint32_t to) const;

  const Model &model_;
  std::vector<Chord> chords_;
  std::vector<uint32_t> part_of_;          // the chord into which it is merged, or itself
  std::vector<std::vector<uint32_t>> at_;  // of each node, ascending
  std::vector<ChordStep> steps_;
};

}  // namespace mvs::core
