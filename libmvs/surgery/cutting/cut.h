// Cutting a piece out of the sheet along an outline.
#pragma once

#include "surgery/leaflet/flat.h"

namespace mvs::core {

// A closed polygon on a flat piece of leaflet.
class Outline {
 public:
  explicit Outline(std::vector<Vec2> points) : points_(std::move(points)) {}
  bool holds(const Vec2 &p) const;
  double area() const;

 private:
  std::vector<Vec2> points_;
};

// What is left of the line that was cut: its nodes, from free edge to free edge.
using CutLine = std::vector<uint32_t>;

// Takes out the tissue inside the outline: triangles are split along it; a node nearer to it than a
// fifth of an edge is cut through instead. Chords that ended on what was taken out go with it;
// nodes that nothing holds any more are left for prune_chords(). Nodes of the annulus have to be
// outside. The flat piece follows the splits.
CutLine cut_out(Surgery &s, Flat &flat, const Outline &outline);

}  // namespace mvs::core
