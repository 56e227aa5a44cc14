// Removal of a piece of the sheet along an outline.
#pragma once

#include "surgery/leaflet/flat.h"

namespace mvs::core {

// A closed polygon on a flattened piece of leaflet.
class Outline {
 public:
  explicit Outline(std::vector<Vec2> points) : points_(std::move(points)) {}
  bool holds(const Vec2 &p) const;
  double area() const;

 private:
  std::vector<Vec2> points_;
};

// The cut: its nodes in order, from free edge to free edge.
using CutLine = std::vector<uint32_t>;

// Removes the tissue inside the outline. Triangles are split along the outline; a node nearer to it
// than a fifth of an edge becomes a node of the cut instead. Chords that end on removed tissue are
// removed; loose nodes are left for prune_chords(). Annulus nodes must lie outside. The flattened
// piece is updated.
CutLine cut_out(Surgery &s, Flat &flat, const Outline &outline);

}  // namespace mvs::core
